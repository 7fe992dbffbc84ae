// Groups the tasks of a plan into job arrays of Slurm, which starts each job as soon as the jobs it depends on are
// done. Threads: plain data.
#pragma once
#include <memory>

#include "reyes/app/batch/plan.h"

namespace tomales {

/// Tasks that are submitted as one array of jobs. Needs that are done already are left out.
struct JobArray {
  std::string name;
  std::vector<const BatchTask*> tasks;
  std::vector<std::string> needs;        ///< Names of tasks that all of them need.
  std::vector<const JobArray*> follows;  ///< Task i also needs task i of each of these arrays.
  std::string job;                       ///< Slurm's number, once it is submitted.
};

using JobArrays = std::vector<std::unique_ptr<JobArray>>;

/// Puts tasks of one stage together if they need the same tasks, or if each needs its counterpart in the same arrays.
/// `wanted` must outlive the arrays.
JobArrays jobArraysOf(const std::vector<BatchTask>& wanted);
/// Returns the jobs that sbatch shall wait for, as --dependency takes them; empty for none. Throws FileError if it
/// would have to wait for jobs that are not submitted yet.
std::string dependencyOf(const JobArray& array, const JobArrays& all);

}  // namespace tomales

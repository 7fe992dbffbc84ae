// Tasks of a plan as arrays of jobs, of which Slurm runs each as soon as what it waits for is done. Threads: plain
// data.
#pragma once
#include <memory>

#include "reyes/app/batch/plan.h"

namespace tomales {

/// Tasks that are submitted as one array of jobs. Their needs are those that are not done.
struct JobArray {
  std::string name;
  std::vector<const BatchTask*> tasks;
  std::vector<std::string> needs;        ///< Names of tasks that all of them need.
  std::vector<const JobArray*> follows;  ///< Besides, each task needs the one of the same number in each of these.
  std::string job;                       ///< Slurm's number, once it is submitted.
};

using JobArrays = std::vector<std::unique_ptr<JobArray>>;

/// Puts tasks of one stage together that need the same tasks, or each its own ones of the same arrays. `wanted` must
/// outlive the arrays.
JobArrays jobArraysOf(const std::vector<BatchTask>& wanted);
/// Returns the jobs that sbatch shall wait for, as --dependency takes them; empty for none. Throws FileError if it
/// would have to wait for jobs that are not submitted yet.
std::string dependencyOf(const JobArray& array, const JobArrays& all);

}  // namespace tomales

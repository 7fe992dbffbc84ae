// Hands a plan to Slurm (slurm.schedmd.com): a readable script for each array of jobs. Threads: one caller.
#pragma once
#include <string>
#include <vector>

#include "reyes/app/batch/plan.h"

namespace tomales {

struct SlurmOptions {
  std::string partition, time, memory;  ///< Values for options of sbatch; empty for the cluster's default.
  int cpus = 1;                         ///< Processors of each task.
  int atOnce = 0;                       ///< Most tasks of one array at a time; 0 for no limit.
};

/// Throws FileError if there is no Slurm, or no such partition.
void checkSlurm(const SlurmOptions& options);
/// Throws FileError if jobs of the plan are on the cluster, or if nobody here can tell.
void refuseIfOnCluster(const BatchPlan& plan);
/// Writes the scripts of tasks that are not done, and submits them. Returns the number of jobs. What was submitted is
/// taken back if one of them is refused, which throws FileError.
size_t submitToSlurm(const BatchPlan& plan, const SlurmOptions& options);
/// Tells whether the plan was given to Slurm.
bool hasJobs(const BatchPlan& plan);
void cancelJobs(const BatchPlan& plan);

}  // namespace tomales

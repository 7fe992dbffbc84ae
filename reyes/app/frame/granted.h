// The resources that a cluster has granted to this process, by the environment that Slurm gives to jobs (sbatch(1),
// OUTPUT ENVIRONMENT VARIABLES). Threads: plain function.
#pragma once
#include "reyes/app/settings.h"
#include "reyes/base/log.h"

namespace tomales {

/// Sets threads and the limit of memory to what was granted where the command line does not ask for others, and tells.
RenderSettings asGranted(RenderSettings settings, Log& log);

}  // namespace tomales

// The resources that a cluster has granted to this process, by the environment that Slurm gives to jobs (sbatch(1),
// OUTPUT ENVIRONMENT VARIABLES). Threads: plain function.
#pragma once
#include "reyes/app/settings.h"
#include "reyes/base/log.h"

namespace tomales {

/// Sets threads and the memory limit to what was granted, unless the command line sets them, and reports this.
RenderSettings asGranted(RenderSettings settings, Log& log);

}  // namespace tomales

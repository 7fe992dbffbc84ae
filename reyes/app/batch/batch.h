// `tomales batch`: frames of a scene as tasks, here or on a cluster.
#pragma once
#include <string>
#include <vector>

#include "reyes/app/batch/make_plan.h"
#include "reyes/app/batch/slurm.h"

namespace tomales {

struct BatchCommand {
  /// The scene's files, or a plan; or an action with the plan first: status, cancel, retry, log FRAME, task NAME.
  std::vector<std::string> what;
  PlanOptions plan;
  SlurmOptions slurm;
  std::string folder;  ///< Folder of plan.json, states and logs; if empty, the scene's name with .batch.
  std::string page;    ///< The HTML page to write; empty for none.
  bool onSlurm = false, json = false;
  bool planOnly = false;  ///< The plan is made, and nothing of it is run.
  int processes = 0;      ///< Processes at a time; 0 for one on each processor.
};
int batchCommand(BatchCommand command);

}  // namespace tomales

// Verb: what frames know of their maps of light -> the tasks that make these before them. Threads: one caller.
#pragma once
#include <map>

#include "reyes/app/batch/make_plan.h"
#include "reyes/app/frame/shared_light.h"

namespace tomales {

/// What a frame has to do with the maps of its light.
struct LightOfFrame {
  std::string folder;                ///< For --atlas; empty: as the user gave it.
  std::vector<std::string> needs;    ///< The tasks that make the maps.
  std::vector<std::string> removes;  ///< Files that nobody needs after the frame.
  /// Tasks to be run with the scene of this frame; one that needs none of the others has no needs yet.
  std::vector<BatchTask> tasks;
};

/// Frames of one world that follow each other share the maps in a folder that is named. Where there are several worlds
/// each has a folder of its own: in one, each would take the place of the last. Without a folder every frame makes its
/// own maps, as in one run, for its own camera. Photons are traced in parts. `frames`: in their order.
std::map<int, LightOfFrame> planLight(const std::vector<std::pair<int, SharedLight>>& frames,
                                      const PlanOptions& options, const std::filesystem::path& work);

}  // namespace tomales

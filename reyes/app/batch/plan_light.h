// Verb: the maps of light that frames need -> the tasks that make them before the frames. Threads: one caller.
#pragma once
#include <map>

#include "reyes/app/batch/make_plan.h"
#include "reyes/app/frame/shared_light.h"

namespace tomales {

/// The tasks and files that connect a frame with the maps of its light.
struct LightOfFrame {
  std::string folder;                ///< Folder for --atlas; empty: as the user gave it.
  std::vector<std::string> needs;    ///< The tasks that make the maps.
  std::vector<std::string> removes;  ///< Files that nobody needs after the frame.
  /// Tasks to be run with the scene of this frame. A task that needs none of the others still has an empty `needs`.
  std::vector<BatchTask> tasks;
};

/// Plans the maps of light. Frames of one world that follow each other share the maps in a folder that is named. If
/// there are several worlds, each has a folder of its own, because in one folder each would replace the maps of the
/// last. Without a folder every frame makes its own maps, as in one run, for its own camera. Photons are traced in
/// parts. `frames`: in their order.
std::map<int, LightOfFrame> planLight(const std::vector<std::pair<int, SharedLight>>& frames,
                                      const PlanOptions& options, const std::filesystem::path& work);

}  // namespace tomales

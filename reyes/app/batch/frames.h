// Verb: scene -> the facts about its frames that a batch needs for its plan. Threads: one caller.
#pragma once
#include <limits>
#include <map>

#include "reyes/app/batch/make_plan.h"
#include "reyes/app/frame/shared_light.h"
#include "reyes/base/log.h"

namespace tomales {

/// The files and maps that a frame of the scene writes.
struct FrameFiles {
  int worlds = 0;
  bool maps = false;                            ///< It writes maps for later frames, and nothing else.
  bool joins = true;                            ///< All are pictures in OpenEXR that can be made of tiles.
  std::vector<std::string> files;               ///< The first is the picture.
  std::vector<std::vector<std::string>> tiles;  ///< The files of each tile; empty without tiles.
  std::optional<SharedLight> light;
};

struct BatchFrames {
  static constexpr int kMake = std::numeric_limits<int>::min();
  std::map<int, FrameFiles> frames;  ///< The frames by their numbers.
  std::vector<int> events;           ///< Numbers of frames, and kMake for Make requests, in the order of the stream.
  bool hasMakes = false;             ///< Some of them are kMake.
  bool apart = true;                 ///< Frames do not depend on each other.
};

/// Reads the scene once, without rendering. Returns nothing if it cannot be read or has no such frames, or if rendering
/// them by such a plan would go wrong, which is reported. The folder of `plan` will hold the tiles.
std::optional<BatchFrames> readFrames(const PlanOptions& options, const BatchPlan& plan, Log& log);

}  // namespace tomales

// Verb: scene and command line -> plan. Threads: one caller.
#pragma once
#include "reyes/app/batch/plan.h"
#include "reyes/app/settings.h"

namespace tomales {

struct PlanOptions {
  RenderSettings render;           ///< Settings of `render`; `frames` are those of the batch.
  std::array<int, 2> tiles{1, 1};  ///< Columns and rows of tiles of each frame.
  /// Frames in a row that share irradiance records, each beginning with those of the one before.
  int sharedRecords = 1;
  /// Tasks that trace the photons of one world; 0: their number follows from that of the photons.
  int photonParts = 0;
  /// Words of the user for options of pictures, for the passes that take them.
  std::vector<std::string> pictureArguments;
  /// Words of the user for options of light, for the passes that take them.
  std::vector<std::string> lightArguments;
  std::vector<std::string> targetArguments;  ///< Words of the user that choose settings of light for frames.
  std::filesystem::path file;                ///< The plan.

  int tileCount() const { return tiles[0] * tiles[1]; }
  /// Tells whether frames are hidden, gathered and shaded in tasks of their own.
  bool inPasses() const { return tileCount() > 1 || sharedRecords > 1; }
};

/// Reads the scene once, without rendering, to find its frames and what they write. Without tiles each frame is one run
/// of `render`; with tiles it is hidden and gathered once, shaded in tiles and joined. Frames that make maps come
/// before all others, and so do the maps of light that frames share. Returns nothing if the scene does not suit a
/// batch, which is reported.
std::optional<BatchPlan> makePlan(const PlanOptions& options, Log& log);

}  // namespace tomales

// `tomales render`: renders every frame of a RIB stream to files.
#pragma once
#include <optional>

#include "reyes/app/exit_code.h"
#include "reyes/app/frame/atlas_job.h"
#include "reyes/app/settings.h"

namespace tomales {

int renderCommand(const RenderSettings& settings);
/// Hides the frames of the same stream, to a .dfb each.
int hideCommand(const RenderSettings& settings);

struct PrepareCommand {
  std::optional<AtlasPass> pass;  ///< If not given, all maps that are missing are made.
  WorkPart part;
};
/// Makes the maps of light that the frames of the same stream share.
int prepareCommand(const RenderSettings& settings, const PrepareCommand& command);

}  // namespace tomales

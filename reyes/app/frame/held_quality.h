// Settings of light that hold for all frames of an animation. If they were found for each frame alone, they would
// change from frame to frame, and so would the errors, which would flicker (docs/decisions/0177).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "reyes/app/frame/error_model.h"
#include "reyes/app/settings.h"

namespace tomales {

struct HeldQuality {
  std::vector<int> pilots;           ///< The frames that they were found on.
  std::vector<LightQuality> worlds;  ///< One for each world of a frame that makes a picture.
};

/// Returns a few of these frames: the first, the middle and the last.
std::vector<int> pilotsOf(const std::vector<int>& frames);

/// Puts the quality into the settings: the frame is lit with it, and no trials are made.
void hold(const LightQuality& quality, RenderSettings& settings);

/// Merges what another pilot has found for a world. With --target-error the finest of all hold, so that each frame
/// reaches the target, and with --time-budget the coarsest, so that each ends in time.
void mergeQuality(HeldQuality& held, size_t world, const LightQuality& quality, const QualitySettings& settings);

/// Reads what an earlier run has found for the same target. Returns nothing, and says why, if the file holds anything
/// else.
std::optional<HeldQuality> readHeldQuality(const std::string& file, const QualitySettings& settings,
                                           std::string& error);
/// Throws WriteError.
void writeHeldQuality(const std::string& file, const HeldQuality& held, const QualitySettings& settings);

}  // namespace tomales

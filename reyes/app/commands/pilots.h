// The pilot frames of an animation: settings of light are found on a few of its frames before any is rendered.
#pragma once
#include <functional>
#include <optional>

#include "reyes/app/frame/held_quality.h"
#include "reyes/base/log.h"

namespace tomales {

/// Tells whether settings of light must hold for all frames of this run: the program chooses them, and there may be
/// several frames, or other runs have some.
bool holdsForAnimation(const RenderSettings& settings);

/// Reads --animation-settings if that file is there. Else finds settings on the pilot frames, which needs all of the
/// stream to be read again, and writes them there. Returns nothing if they cannot be found before rendering begins: the
/// stream has one frame, or is standard input; or if something fails, which is in the log.
std::optional<HeldQuality> findHeldQuality(const RenderSettings& settings, Log& log);

}  // namespace tomales

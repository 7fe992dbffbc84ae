// Explains requests of scenes that Tomales ignores: the reason, and what it does instead.
#pragma once
#include <string>
#include <string_view>

namespace tomales::rib {

/// The most samples of a pixel that Hider "raytrace" may ask for: a path tracer asks for more than a Reyes hider needs.
constexpr int kMostTracedSamples = 64;

/// `what` is a request ("PixelVariance"), or "Option category:name", "Attribute category:name", "Hider name",
/// "Hider:parameter". The result begins with a colon and a blank, or is empty if there is nothing to add.
std::string reasonFor(std::string_view what);

}  // namespace tomales::rib

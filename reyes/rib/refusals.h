// What scenes ask for and Tomales does not do: why, and what does it instead.
#pragma once
#include <string>
#include <string_view>

namespace tomales::rib {

/// `what`: a request ("PixelVariance"), or "Option category:name", "Attribute category:name", "Hider name",
/// "Hider:parameter". Begins with a colon and a blank; empty if there is nothing to add.
std::string reasonFor(std::string_view what);

}  // namespace tomales::rib

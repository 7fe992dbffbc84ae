// Private to reading RIB: attributes that an object has beside those that are set when it is drawn.
#pragma once
#include "reyes/rib/graphics_state.h"

namespace tomales::rib {

/// Returns the attributes of the primitive that a request draws now. With Surface "null" nobody sees it, but it may
/// emit. In passes for depth alone "null" means, by custom, that no shader need run. Strings of the primitive take the
/// place of those of its shaders.
std::shared_ptr<Attributes> attributesOf(const Request& r, GraphicsState& s);

}  // namespace tomales::rib

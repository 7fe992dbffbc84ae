// Private to reading RIB: the attributes of an object, which may differ from the current ones.
#pragma once
#include "reyes/rib/graphics_state.h"

namespace tomales::rib {

/// Returns the attributes of the primitive that a request draws now. An object with Surface "null" is invisible, but
/// may emit. In passes for depth alone, "null" means by convention only that no shader need run. Strings of the
/// primitive replace strings of its shaders.
std::shared_ptr<Attributes> attributesOf(const Request& r, GraphicsState& s);

}  // namespace tomales::rib

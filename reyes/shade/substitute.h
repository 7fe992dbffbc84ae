// The shader that replaces a missing one, so conspicuous that nobody ships a frame with it.
#pragma once
#include "reyes/shader_api.h"

namespace tomales {
const TmShader& substituteSurface();  ///< A magenta and black checker in u, v that needs no light.
}  // namespace tomales

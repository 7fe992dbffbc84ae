// The shader that stands in for one that is missing: nobody should ship a frame with it.
#pragma once
#include "reyes/shader_api.h"

namespace tomales {
const TmShader& substituteSurface();  ///< Magenta and black checks in u, v; no light.
}  // namespace tomales

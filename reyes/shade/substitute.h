// What replaces missing shaders. The surface is so conspicuous that nobody ships a frame with it. A scene without its
// lights would show nothing, so a light is replaced by the standard one that is most like it.
#pragma once
#include "reyes/shader_api.h"
#include "reyes/state.h"

namespace tomales {
const TmShader& substituteSurface();  ///< A magenta and black checker in u, v that needs no light.

/// Returns the name of the standard light that is most like what the scene asks for, by its name, parameters and place;
/// "" if it seems to bring indirect light.
const char* standardLightFor(const ShaderCall& call, bool area);
/// Returns the call without the parameters that the shader does not have.
ShaderCall callFor(const TmShader& shader, const ShaderCall& call);
}  // namespace tomales

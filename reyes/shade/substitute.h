// What stands in for shaders that are missing. The surface is so loud that nobody ships a frame with it; a scene
// without its lights would show nothing, so they are likely ones.
#pragma once
#include "reyes/shader_api.h"
#include "reyes/state.h"

namespace tomales {
const TmShader& substituteSurface();  ///< A magenta and black checker in u, v that needs no light.

/// Returns the name of the standard light that is likeliest to be what the scene asks for, by its name, parameters and
/// place; "" if it seems to bring light that others have sent.
const char* standardLightFor(const ShaderCall& call, bool area);
/// Returns the call without the parameters that the shader does not have.
ShaderCall callFor(const TmShader& shader, const ShaderCall& call);
}  // namespace tomales

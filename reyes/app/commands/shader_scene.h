// The scene that `tomales shadetest` tries a shader in: a unit square that faces the eye from five units away, under an
// ambient and a distant light, in empty space.
#pragma once
#include <array>
#include <memory>
#include <string>

#include "reyes/scene.h"
#include "reyes/shade.h"

namespace tomales {

/// `parameters` follow the shader's name in its request.
std::string shaderSceneRib(const TmShader& shader, const std::string& parameters = {});

/// Returns points along u and v, as the eye sees the square.
ShadePoints shaderScenePoints(const Scene& scene, const ShadingSystem& shading, const std::array<int, 2>& size);

/// Provides rays that meet nothing, and a lamp for shaders that are sampled on one. Returns null for a shader that
/// declares neither; one that asks for rays all the same then gets a message that it must declare them.
std::unique_ptr<ShadeServices> emptySpaceFor(const TmShader& shader);

}  // namespace tomales

// Named coordinate systems (RISpec 3.2, table 4.1) as seen from a running shader.
#pragma once
#include <optional>
#include <string>

#include "reyes/shade/batch.h"
#include "reyes/shader_api.h"

namespace tomales {

/// A space and its transformation to current. In the three projected spaces z stays camera-space depth: with
/// RenderMan's default clipping planes (1e-6, 1e30) a projective depth would have no precision left.
struct Space {
  enum Kind { Linear, Raster, Ndc, Screen } kind = Linear;
  mat4 currentFromSpace{1.0f};
};

/// Returns nothing if there is no such space.
std::optional<Space> findSpace(const Batch& batch, const std::string& name);

/// Returns the rotation from current space to the directions by which environment() looks up a picture in the named
/// space (null: "world"). An unknown name is reported, and the world is used.
mat3 environmentDirections(const Batch& batch, const char* space);

/// Transforms a point to a projected space. Vectors and normals have no such transformation.
vec3 projectedFromCurrent(const Batch& batch, Space::Kind kind, const vec3& p);
/// Transforms a point back from a projected space. A depth of 0 means the near clipping plane, as in RISpec. Shaders
/// often ask for the corners of the picture by transform("NDC", "screen", point (x, y, 0)), and no position in the
/// picture has the depth of the eye.
vec3 currentFromProjected(const Batch& batch, Space::Kind kind, const vec3& p);

}  // namespace tomales

// Normals for meshes that have none.
#pragma once
#include <vector>

#include "reyes/base/math.h"

namespace tomales::model {

/// Returns a unit normal for each corner of each face. It is the mean over those faces around the corner's point that
/// turn from the corner's own face by less than `crease_degrees`, weighted by their angles there (Thuermer and
/// Wuethrich 1998). `counts`: corners of each face. `corners`: points of all faces, one face after another.
std::vector<vec3> smoothNormals(const std::vector<vec3>& points, const std::vector<int>& counts,
                                const std::vector<int>& corners, float crease_degrees);

}  // namespace tomales::model

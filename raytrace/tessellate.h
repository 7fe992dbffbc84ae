// Verb: the objects of a scene -> coarse quadrilaterals for rays, merged by shade group.
//   in     a frozen scene; displacement where trace:displacements asks for it
//   out    vertices in current space at the motion keys of raytrace/motion_keys.h, quads, and the object, patch
//          and (u,v) of every quad
//   never  depends on threads: the order is that of objects and patches
// Rate: where the camera can see the object, polygons are about 16 pixels long, times sqrt(ShadingRate) /
// trace:tessellation. Everywhere the normal turns by at most 15 degrees / trace:tessellation along a polygon, as long
// as that is longer than 1.5 pixels. Flat patches are one exact quad.
#pragma once
#include <array>

#include "raytrace/coarse_rate.h"
#include "reyes/shade.h"

namespace tomales {

/// A lattice of quads cut from a rectangle of one patch. Quad (i, j) is firstQuad + j * nu + i.
struct Lattice {
  int object = -1;
  uint32_t patch = 0;
  UvRect rect;
  uint32_t nu = 1, nv = 1;
  uint32_t firstQuad = 0;
  const Prim* trim = nullptr;  ///< The shape whose trim curves cut the lattice; null: nothing is cut.
};

/// Corners (0,0), (1,0), (1,1), (0,1) of the quad's own unit square.
using Quad = std::array<uint32_t, 4>;

/// All coarse polygons of one shade group.
struct CoarseGroup {
  /// Positions at shutter open, and unit normals on the RISpec side. At least 4 readable bytes follow P, and P of later
  /// keys.
  std::vector<vec3> P, N;
  std::vector<std::vector<vec3>> laterP;  ///< P at the later motion keys, which divide the shutter equally.
  std::vector<Quad> quads;
  std::vector<uint32_t> latticeOfQuad;
  std::vector<Lattice> lattices;
  bool trimmed = false;      ///< Trim curves cut some quad.
  DetailShare detail;        ///< Rays of other shares pass through.
  bool solid = false;        ///< The group is part of a solid: solid_hits.h decides which surfaces rays meet.
  bool flipsNormal = false;  ///< The RISpec side is opposite to dP/du x dP/dv.
  /// The number of quads at the end that have finer levels (raytrace/chunks.h): only coarse rays see them.
  size_t onlyCoarse = 0;
  /// Largest distance between a polygon and the surface that it stands for, without `onlyCoarse`.
  float deviation = 0;
  float coarseDeviation = 0;  ///< The same for `onlyCoarse`.
  float size = 0;             ///< Diagonal of the largest object's bound.

  vec3 corner(uint32_t quad, int k) const { return P[quads[quad][static_cast<size_t>(k)]]; }
  std::array<vec3, 4> corners(uint32_t quad) const {
    return {corner(quad, 0), corner(quad, 1), corner(quad, 2), corner(quad, 3)};
  }
  vec3 geometricNormal(uint32_t quad) const;  ///< Unit normal on the RISpec side.
  /// Returns a point of the two triangles that rays meet, cut from corner 1 to 3.
  vec3 pointOn(uint32_t quad, float u, float v) const;
  const Lattice& latticeOf(uint32_t quad) const { return lattices[latticeOfQuad[quad]]; }
  vec2 patchParameters(uint32_t quad, float u, float v) const;
  /// Tells whether this point of a quad remains after trimming.
  bool keeps(uint32_t quad, float u, float v) const {
    const Lattice& l = latticeOf(quad);
    const vec2 at = l.trim ? patchParameters(quad, u, v) : vec2(0);
    return !l.trim || l.trim->keeps(l.patch, at.x, at.y);
  }
  size_t bytes() const;
};

/// Returns the area of the two triangles that rays meet of a polygon, cut from corner 1 to 3.
inline float areaOf(const std::array<vec3, 4>& corners) {
  const auto& [a, b, c, d] = corners;
  return 0.5f * (glm::length(cross(b - a, d - a)) + glm::length(cross(d - c, b - c)));
}

/// Factor on the deviation of a coarse surface that gives the distance by which rays keep away from it
/// (docs/decisions/0006).
constexpr float kOffsetFactor = 1.5f;

/// Returns one element for each of scene.groups. It leaves out objects that no ray may meet and no light is made of,
/// objects that are `elsewhere`, and patches that rays of all levels see in chunks (raytrace/chunks.h). Edges are
/// `longer` times as long as asked.
std::vector<CoarseGroup> tessellate(const Scene& scene, const Camera& camera, const ShadingSystem& shading, Log& log,
                                    const std::vector<bool>& elsewhere = {}, float longer = 1);

/// Returns the factor on the length of edges with which the result of tessellate() and Embree's tree fit into `bytes`;
/// at least 1. Warns if it is more. `elsewhere` as above.
float edgesThatFit(const Scene& scene, const Camera& camera, const std::vector<bool>& elsewhere, size_t bytes,
                   Log& log);
/// Tessellates one object alone.
CoarseGroup tessellateObject(const Scene& scene, const Camera& camera, const ShadingSystem& shading, int object,
                             Log& log);

void reportNotFinite(const Object& object, Log& log);  ///< Warns that rays pass through a part of the object.

bool raysNeed(const Attributes& attributes);  ///< True if some ray may meet the object, or if a light is made of it.

}  // namespace tomales

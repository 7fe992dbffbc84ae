// Verb: the objects of a scene -> coarse quadrilaterals for rays, merged by shade group.
//   in     a frozen scene; displacement where trace:displacements asks for it
//   out    vertices in current space at the motion keys of raytrace/ray_times.h, quads, and the way back from a quad to
//   object, patch and (u,v) never  depends on threads: the order is that of objects and patches
// Rate: polygons of about 16 pixels (x sqrt(ShadingRate) / trace:tessellation) where the camera can see the
// object, and a turn of the normal of at most 15 degrees (/ trace:tessellation) everywhere, as long as
// polygons are larger than 1.5 pixels; flat patches are one exact quad.
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
  const Prim* trim = nullptr;  ///< Asked what trim curves leave; null: nothing is cut.
};

/// Corners (0,0), (1,0), (1,1), (0,1) of the quad's own unit square.
using Quad = std::array<uint32_t, 4>;

/// All coarse polygons of one shade group.
struct CoarseGroup {
  std::vector<vec3> P, N;  ///< At shutter open. N: RISpec side, unit length. Behind P, and P of later keys, lie at
                           ///< least 4 more readable bytes.
  std::vector<std::vector<vec3>> laterP;  ///< P at the motion keys after that, which divide the shutter equally.
  std::vector<Quad> quads;
  std::vector<uint32_t> latticeOfQuad;
  std::vector<Lattice> lattices;
  bool trimmed = false;      ///< Trim curves cut some quad.
  DetailShare detail;        ///< Rays of other shares pass through.
  bool solid = false;        ///< Parts of solids: what rays meet is decided in solid_hits.h.
  bool flipsNormal = false;  ///< The RISpec side is opposite to dP/du x dP/dv.
  size_t onlyCoarse =
      0;  ///< The last so many quads have finer levels (raytrace/chunks.h): rays of the coarse level alone see them.
  float deviation =
      0;  ///< Largest distance between a polygon and the micropolygons that stand for it; without `onlyCoarse`,
  float coarseDeviation = 0;  ///< and of those.
  float size = 0;             ///< Diagonal of the largest object.

  vec3 corner(uint32_t quad, int k) const { return P[quads[quad][static_cast<size_t>(k)]]; }
  std::array<vec3, 4> corners(uint32_t quad) const {
    return {corner(quad, 0), corner(quad, 1), corner(quad, 2), corner(quad, 3)};
  }
  vec3 geometricNormal(uint32_t quad) const;  ///< RISpec side, unit length.
  vec3 pointOn(uint32_t quad, float u,
               float v) const;  ///< On the two triangles that rays meet, cut from corner 1 to 3.
  const Lattice& latticeOf(uint32_t quad) const { return lattices[latticeOfQuad[quad]]; }
  vec2 patchParameters(uint32_t quad, float u, float v) const;
  /// Do trim curves leave this point of a quad?
  bool keeps(uint32_t quad, float u, float v) const {
    const Lattice& l = latticeOf(quad);
    const vec2 at = l.trim ? patchParameters(quad, u, v) : vec2(0);
    return !l.trim || l.trim->keeps(l.patch, at.x, at.y);
  }
  size_t bytes() const;
};

/// Rays keep away from a coarse surface by so much of its deviation: docs/decisions/0006-hit-list-offset.md
constexpr float kOffsetFactor = 1.5f;

/// One for each of scene.groups; empty for what no ray may meet and no light is made of, for objects that are
/// `elsewhere`, and for patches that rays of all levels see in chunks (raytrace/chunks.h).
std::vector<CoarseGroup> tessellate(const Scene& scene, const Camera& camera, const ShadingSystem& shading, Log& log,
                                    const std::vector<bool>& elsewhere = {});
/// One object alone.
CoarseGroup tessellateObject(const Scene& scene, const Camera& camera, const ShadingSystem& shading, int object,
                             Log& log);

bool raysNeed(const Attributes& attributes);  ///< Some ray may meet it, or a light is made of it.

}  // namespace tomales

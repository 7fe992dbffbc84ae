// Private to the primitives: the limit surface of one face of a SubdivisionMesh by OpenSubdiv's Bfr, which evaluates it
// from the coarse mesh.
#pragma once
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/bfr/surfaceFactoryCache.h>

#include <functional>
#include <mutex>
#include <optional>
#include <shared_mutex>

#include "reyes/prim/bicubic.h"

namespace tomales {

using LimitFactory = OpenSubdiv::Bfr::RefinerSurfaceFactory<OpenSubdiv::Bfr::SurfaceFactoryCacheThreaded<
    std::shared_mutex, std::shared_lock<std::shared_mutex>, std::unique_lock<std::shared_mutex>>>;

/// Returns options so accurate that only the 2^-8th part of a face next to an irregular vertex is approximated.
OpenSubdiv::Bfr::SurfaceFactory::Options limitOptions();

/// One face's surface and its values, ready to evaluate.
struct Limit {
  OpenSubdiv::Bfr::Surface<float> surface;
  std::vector<float> points;

  void prepare(const float* meshValues, int width) {
    points.resize(static_cast<size_t>(surface.GetNumPatchPoints()) * static_cast<size_t>(width));
    surface.PreparePatchPoints(meshValues, width, points.data(), width);
  }
};

/// Returns the face as one bicubic patch if its neighbourhood is regular. That is faster to evaluate and has tighter
/// bounds. Pre: `limit` holds positions.
std::optional<BezierPatch> asBicubic(const Limit& limit);

/// Maps a patch's unit square to the coordinates of its face. A patch is a whole quadrilateral, or one corner's part of
/// a face of another size: the quadrilateral of the corner, the middles of its two edges and the centre.
class FaceMap {
 public:
  FaceMap() = default;  ///< The identity.
  FaceMap(const OpenSubdiv::Bfr::Parameterization& face, int corner);
  vec2 at(float u, float v) const { return origin_ + u * alongU_ + v * alongV_ + u * v * twist_; }
  vec2 byU(float v) const { return alongU_ + v * twist_; }
  vec2 byV(float u) const { return alongV_ + u * twist_; }

 private:
  vec2 origin_{0, 0}, alongU_{1, 0}, alongV_{0, 1}, twist_{0, 0};
};

/// Returns a face's position at its own coordinates, and sets the derivatives by these unless the pointers are null.
using FaceAt = std::function<vec3(const vec2& at, vec3* ds, vec3* dt)>;

void evaluateFace(const FaceAt& face, const FaceMap& map, int n, const float* u, const float* v, SurfacePoints out);

/// Returns the bound of a piece of a face: the box around its samples (boundOfSamples()), cut to `hull`, a box around
/// control points with positive weights.
Bound3 boundFace(const FaceAt& face, const FaceMap& map, const UvRect& rect, const Bound3& hull);

}  // namespace tomales

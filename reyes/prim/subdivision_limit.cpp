#include "reyes/prim/subdivision_limit.h"

#include "reyes/prim/interpolation.h"
#include "reyes/prim/sampled_bound.h"

namespace tomales {
namespace {

namespace Bfr = OpenSubdiv::Bfr;

struct Frame {
  vec3 p, du, dv;
};

Frame frameAt(const FaceAt& face, const FaceMap& map, float u, float v) {
  const vec2 byU = map.byU(v), byV = map.byV(u);
  vec3 ds, dt;
  const vec3 p = face(map.at(u, v), &ds, &dt);
  return {p, byU.x * ds + byU.y * dt, byV.x * ds + byV.y * dt};
}

/// Returns the cross product of the derivatives, or normalNearby() where they are parallel or zero.
vec3 normalAt(const FaceAt& face, const FaceMap& map, float u, float v, const Frame& frame) {
  constexpr float kLeastSine = 1e-4f;
  const vec3 normal = cross(frame.du, frame.dv);
  if (glm::length(normal) > kLeastSine * glm::length(frame.du) * glm::length(frame.dv)) return normal;
  return normalNearby(u, v, kLeastSine, [&](float a, float b) {
    const Frame nearby = frameAt(face, map, a, b);
    return std::pair(nearby.du, nearby.dv);
  });
}

}  // namespace

/// Converts control points of a uniform B-spline, u fastest. Next to a boundary or a crease, Bfr repeats control points
/// in place of missing ones; such faces are left to Bfr.
std::optional<BezierPatch> asBicubic(const Limit& limit) {
  constexpr size_t kControls = 16;
  if (!limit.surface.IsRegular() || limit.surface.IsLinear() || limit.surface.GetNumControlPoints() != int{kControls})
    return {};
  std::array<int, kControls> index;
  limit.surface.GetControlPointIndices(index.data());
  std::sort(index.begin(), index.end());
  if (std::adjacent_find(index.begin(), index.end()) != index.end()) return {};
  static const ToBezier kToBezier = bezierFrom(bsplineBasis());
  BezierPatch patch;
  for (size_t axis = 0; axis < 3; ++axis) {
    BezierNet controls;
    for (size_t k = 0; k < kControls; ++k) controls[k] = limit.points[3 * k + axis];
    patch[axis] = convertNet(controls, kToBezier, kToBezier);
  }
  return patch;
}

Bfr::SurfaceFactory::Options limitOptions() {
  constexpr int kLevel = 8;
  return Bfr::SurfaceFactory::Options().SetApproxLevelSmooth(kLevel).SetApproxLevelSharp(kLevel);
}

FaceMap::FaceMap(const Bfr::Parameterization& face, int corner) {
  if (face.GetType() == Bfr::Parameterization::TRI) {
    static constexpr vec2 kCorners[] = {{0, 0}, {1, 0}, {0, 1}};
    const vec2 here = kCorners[corner], next = kCorners[(corner + 1) % 3], last = kCorners[(corner + 2) % 3];
    const vec2 center(1 / 3.0f);
    origin_ = here;
    alongU_ = 0.5f * (next - here);
    alongV_ = 0.5f * (last - here);
    twist_ = center - here - alongU_ - alongV_;
  } else if (face.HasSubFaces()) {
    const float zero[2] = {0, 0}, one[2] = {1, 1};
    vec2 to;
    face.ConvertNormalizedSubFaceToCoord(corner, zero, &origin_.x);
    face.ConvertNormalizedSubFaceToCoord(corner, one, &to.x);
    alongU_.x = alongV_.y = to.x - origin_.x;
  }
}

void evaluateFace(const FaceAt& face, const FaceMap& map, int n, const float* u, const float* v, SurfacePoints out) {
  for (int i = 0; i < n; ++i) {
    const Frame f = frameAt(face, map, u[i], v[i]);
    setFrame(out, i, f.p, f.du, f.dv);
    setNormal(out, i, normalAt(face, map, u[i], v[i], f));
  }
}

Bound3 boundFace(const FaceAt& face, const FaceMap& map, const UvRect& rect, const Bound3& hull) {
  const Bound3 sampled = boundOfSamples(rect, [&](float u, float v) { return face(map.at(u, v), nullptr, nullptr); });
  return paddedForRounding({glm::max(hull.lo, sampled.lo), glm::min(hull.hi, sampled.hi)}, hull);
}

}  // namespace tomales

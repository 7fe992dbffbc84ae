#include "reyes/split/rate.h"

#include "reyes/split/probes.h"

namespace tomales {
namespace {

/// Motion keys at which a moving patch is measured: it may grow, or come nearer.
constexpr size_t kMostKeys = 5;

// The lines of a flat patch are straight, and the longest is one of its edges.
constexpr int kFlatProbes = 1, kCurvedProbes = 4;
/// Length of a triangle along u over the length of its foot, as a root mean square over its area, since its edge v = 1
/// has no length. On average its cells are smaller than the rate asks; the largest, at its foot, have 1.4 times the
/// area.
constexpr float kTriangle = 0.70710678f;

/// An object at a time.
struct Pose {
  ShapesAround shapes;
  mat4 cameraFromObject;
};
Pose poseAt(const Object& o, float time) { return {o.shapesAround(time), o.cameraFromObject.at(time)}; }

/// patchAt(i) returns one of up to kPatches patches; put(i, size) receives its size.
template <int kProbes, int kPatches, class PatchAt, class Put>
void measureSome(const Object& o, const Pose& pose, const Camera& camera, int count, const PatchAt& patchAt,
                 const UvRect& r, const Put& put) {
  using L = ProbeLattice<kProbes, kPatches>;
  L at;
  float u[L::kCount], v[L::kCount];
  for (int j = 0, k = 0; j < L::kRow; ++j)
    for (int i = 0; i < L::kRow; ++i, ++k) {
      u[k] = lerp(r.u0, r.u1, static_cast<float>(i) / kProbes);
      v[k] = lerp(r.v0, r.v1, static_cast<float>(j) / kProbes);
    }
  float data[12][L::kCount], next[12][L::kCount];
  const auto evaluate = [&](const Prim& shape, int i, float(&to)[12][L::kCount]) {
    shape.evaluate(patchAt(i), L::kCount, u, v,
                   {to[0], to[1], to[2], to[3], to[4], to[5], to[6], to[7], to[8], to[9], to[10], to[11]});
  };
  for (int i = 0; i < kPatches; ++i) {
    if (i < count) evaluate(*pose.shapes.before, i, data);
    if (i < count && pose.shapes.after) {
      evaluate(*pose.shapes.after, i, next);
      for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < L::kCount; ++k) data[axis][k] = lerp(data[axis][k], next[axis][k], pose.shapes.t);
    }
    for (int k = 0; k < L::kCount; ++k) at.x[k][i] = data[0][k], at.y[k][i] = data[1][k], at.z[k][i] = data[2][k];
  }
  ProbeSizes<kPatches> sizes;
  measureLattice(at, pose.cameraFromObject, camera, o.attributes->rasterOrient, sizes);
  for (int i = 0; i < count; ++i) {
    const auto &su = sizes.u, &sv = sizes.v;
    constexpr int c = L::kCount - L::kRow, d = L::kCount - 1;
    const bool triangle =
        kProbes == kFlatProbes && at.x[c][i] == at.x[d][i] && at.y[c][i] == at.y[d][i] && at.z[c][i] == at.z[d][i];
    const float share = triangle ? kTriangle : 1.0f;
    put(i, PatchSize{
               {share * su.px[i], su.length[i], su.least[i], su.bend_px[i]},
               {sv.px[i], sv.length[i], sv.least[i], sv.bend_px[i]},
               share * sizes.area_px2[i],
               {{sizes.lo[0][i], sizes.lo[1][i], sizes.lo[2][i]}, {sizes.hi[0][i], sizes.hi[1][i], sizes.hi[2][i]}}});
  }
}

/// Calls measureAt(pose, put of sizes) at each key that is measured; out(i) is the largest size of patch i over the
/// keys. Where a patch is behind the eye or outside of the picture its size is not limited.
template <class MeasureAt, class Out>
void measureAtKeys(const Object& o, const Camera& camera, const MeasureAt& measureAt, const Out& out) {
  const size_t last = o.keyTimes.size() - 1, keys = std::min(last + 1, kMostKeys);
  measureAt(poseAt(o, o.keyTimes.front()), [&](size_t i, const PatchSize& size) { out(i) = size; });
  for (size_t k = 1; k < keys; ++k)
    measureAt(poseAt(o, o.keyTimes[k * last / (keys - 1)]), [&](size_t i, const PatchSize& size) {
      const bool behind = camera.perspective() && size.probes.lo.z < camera.eyePlane();
      if (!behind && !camera.outsideWindow(size.probes, {0, 0, camera.xResolution(), camera.yResolution()}))
        out(i).extend(size);
    });
}

template <int kProbes, class Put>
void measureThose(bool planar, const Object& o, const Pose& pose, const Camera& camera,
                  std::span<const uint32_t> patches, const Put& put) {
  std::vector<uint32_t> these;
  for (uint32_t i = 0; i < patches.size(); ++i)
    if (o.shape().info(patches[i]).planar == planar) these.push_back(i);
  for (size_t first = 0; first < these.size(); first += kLanes) {
    const int count = static_cast<int>(std::min<size_t>(kLanes, these.size() - first));
    measureSome<kProbes, kLanes>(
        o, pose, camera, count, [&](int i) { return patches[these[first + static_cast<size_t>(i)]]; }, UvRect{},
        [&](int i, const PatchSize& size) { put(these[first + static_cast<size_t>(i)], size); });
  }
}

}  // namespace

void PatchSize::extend(const PatchSize& other) {
  for (const auto& [line, more] : {std::pair(&u, &other.u), std::pair(&v, &other.v)})
    *line = {std::max(line->px, more->px), std::max(line->length, more->length), std::max(line->least, more->least),
             std::max(line->bend_px, more->bend_px)};
  area_px2 = std::max(area_px2, other.area_px2);
  probes.extend(other.probes);
}

std::vector<PatchSize> measureWhole(const Object& o, const Camera& camera, std::span<const uint32_t> patches) {
  std::vector<PatchSize> out(patches.size());
  const auto measureAt = [&](const Pose& pose, const auto& put) {
    measureThose<kFlatProbes>(true, o, pose, camera, patches, put);
    measureThose<kCurvedProbes>(false, o, pose, camera, patches, put);
  };
  measureAtKeys(o, camera, measureAt, [&](size_t i) -> PatchSize& { return out[i]; });
  return out;
}

PatchSize measure(const Object& o, const Camera& camera, uint32_t patch, const UvRect& r) {
  PatchSize out;
  const auto patchAt = [&](int) { return patch; };
  const bool planar = o.shape().info(patch).planar;
  const auto measureAt = [&](const Pose& pose, const auto& put) {
    const auto putIt = [&](int, const PatchSize& size) { put(0, size); };
    if (planar)
      measureSome<kFlatProbes, 1>(o, pose, camera, 1, patchAt, r, putIt);
    else
      measureSome<kCurvedProbes, 1>(o, pose, camera, 1, patchAt, r, putIt);
  };
  measureAtKeys(o, camera, measureAt, [&](size_t) -> PatchSize& { return out; });
  return out;
}

}  // namespace tomales

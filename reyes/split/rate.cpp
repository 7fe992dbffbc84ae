// Lines of a lattice of probes over a rectangle are measured chord by chord. Whole patches are measured sixteen at a
// time, a vector of them at each step: most scenes with many patches have small ones.
#include "reyes/split/rate.h"

#include <cmath>

#include "reyes/base/simd.h"

namespace tomales {
namespace {

/// Motion keys at which a moving patch is measured: it may grow, or come nearer.
constexpr size_t kMostKeys = 5;

/// Probes of kPatches patches; point k of all of them is adjacent. Rows of points run along u.
template <int kProbesT, int kPatchesT>
struct Lattice {
  static constexpr int kProbes = kProbesT, kPatches = kPatchesT, kRow = kProbes + 1, kCount = kRow * kRow;
  alignas(64) float x[kCount][kPatches], y[kCount][kPatches], z[kCount][kPatches];  ///< Positions in camera space.
  alignas(64) float rasterX[kCount][kPatches], rasterY[kCount][kPatches];
};

/// PatchSize of kPatches patches.
template <int kPatches>
struct Sizes {
  struct Line {
    alignas(64) float px[kPatches], length[kPatches], bend_px[kPatches];
    alignas(64) int least[kPatches];
  };
  Line u, v;
  alignas(64) float area_px2[kPatches];
  alignas(64) float lo[3][kPatches], hi[3][kPatches];
};

/// The part of a second difference across the line; the part along it is a change of speed only.
inline float bend(float x0, float y0, float x1, float y1, float x2, float y2) {
  const float alongX = x2 - x0, alongY = y2 - y0, secondX = x2 - 2.0f * x1 + x0, secondY = y2 - 2.0f * y1 + y0;
  const float length = std::sqrt(alongX * alongX + alongY * alongY),
              second = std::sqrt(secondX * secondX + secondY * secondY);
  const float across = std::abs(alongX * secondY - alongY * secondX) / length;
  const float finite = across < kInfinity ? across : 0.0f;
  return length > 1e-3f * second ? finite : second;  // else the line goes there and back
}

/// Least number of chords of a line, however short, that enclose an area: it bends round (a meridian), or closes on
/// itself (a parallel).
inline int leastCells(float length, float endToEnd) {
  return endToEnd < 0.3f * length ? 6 : endToEnd < 0.8f * length ? 4 : 1;
}

/// Measures the line of points first, first + step, ..., and keeps the larger values in `out`.
template <class L>
[[gnu::always_inline]] inline void measureLine(const L& __restrict at, int first, int step, const Camera& camera,
                                               bool asSeen, typename Sizes<L::kPatches>::Line& __restrict out) {
  constexpr int n = L::kPatches;
  float length_px[n] = {}, length[n] = {}, chord[n];
  for (int k = 0; k < L::kProbes; ++k) {
    const int a = first + k * step, b = a + step;
    for (int i = 0; i < n; ++i) {
      const float dx = at.x[b][i] - at.x[a][i], dy = at.y[b][i] - at.y[a][i], dz = at.z[b][i] - at.z[a][i];
      chord[i] = std::sqrt(dx * dx + dy * dy + dz * dz);
      length[i] += chord[i];
    }
    for (int i = 0; asSeen && i < n; ++i) {
      const float dx = at.rasterX[b][i] - at.rasterX[a][i], dy = at.rasterY[b][i] - at.rasterY[a][i];
      length_px[i] += std::sqrt(dx * dx + dy * dy);
    }
    // Without rasterorient a micropolygon is as large as if it faced the camera (rispec-table 4, dice:rasterorient).
    for (int i = 0; !asSeen && i < n; ++i)
      length_px[i] += chord[i] / camera.pixelSize({at.x[a][i], at.y[a][i], at.z[a][i]});
    if (k == 0) continue;
    const int c = a - step;
    for (int i = 0; i < n; ++i) {
      const float bends = bend(at.rasterX[c][i], at.rasterY[c][i], at.rasterX[a][i], at.rasterY[a][i], at.rasterX[b][i],
                               at.rasterY[b][i]);
      out.bend_px[i] = out.bend_px[i] < bends ? bends : out.bend_px[i];
    }
  }
  const int last = first + L::kProbes * step;
  for (int i = 0; i < n; ++i) {
    const float dx = at.x[last][i] - at.x[first][i], dy = at.y[last][i] - at.y[first][i],
                dz = at.z[last][i] - at.z[first][i];
    const int least = leastCells(length[i], std::sqrt(dx * dx + dy * dy + dz * dz));
    out.least[i] = out.least[i] < least ? least : out.least[i];
    out.length[i] = out.length[i] < length[i] ? length[i] : out.length[i];
    out.px[i] = out.px[i] < length_px[i] ? length_px[i] : out.px[i];
  }
}

/// Twice the area in pixels of the triangle at `a` whose sides go to `b` and `c`; `out` keeps the larger value.
template <class L>
[[gnu::always_inline]] inline void measureCorner(const L& __restrict at, int a, int b, int c, const Camera& camera,
                                                 bool asSeen, float* __restrict out) {
  constexpr int n = L::kPatches;
  float area[n];
  for (int i = 0; asSeen && i < n; ++i) {
    const float bx = at.rasterX[b][i] - at.rasterX[a][i], by = at.rasterY[b][i] - at.rasterY[a][i];
    const float cx = at.rasterX[c][i] - at.rasterX[a][i], cy = at.rasterY[c][i] - at.rasterY[a][i];
    area[i] = std::abs(bx * cy - by * cx);
  }
  for (int i = 0; !asSeen && i < n; ++i) {
    const vec3 o{at.x[a][i], at.y[a][i], at.z[a][i]};
    const vec3 across =
        cross(vec3(at.x[b][i], at.y[b][i], at.z[b][i]) - o, vec3(at.x[c][i], at.y[c][i], at.z[c][i]) - o);
    const float size = camera.pixelSize(o);
    area[i] = std::sqrt(dot(across, across)) / (size * size);
  }
  for (int i = 0; i < n; ++i) out[i] = out[i] < area[i] ? area[i] : out[i];
}

/// The area if all parts were as large as the largest between two lines of probes each.
template <class L>
[[gnu::always_inline]] inline void measureArea(const L& __restrict at, const Camera& camera, bool asSeen,
                                               float* __restrict out) {
  for (int i = 0; i < L::kPatches; ++i) out[i] = 0;
  for (int v = 0; v < L::kProbes; ++v)
    for (int u = 0; u < L::kProbes; ++u) {
      const int a = v * L::kRow + u, b = a + 1, c = a + L::kRow, d = c + 1;
      measureCorner(at, a, b, c, camera, asSeen, out);
      measureCorner(at, d, c, b, camera, asSeen, out);
    }
  for (int i = 0; i < L::kPatches; ++i) out[i] *= static_cast<float>(L::kProbes * L::kProbes);
}

/// Transforms object space to camera space, in the order of glm's product, and to raster.
template <class L>
[[gnu::always_inline]] inline void place(L& __restrict at, const mat4& m, const Camera& camera) {
  const float nearest = camera.perspective() ? camera.nearClip() : -kInfinity;
  const bool affine = m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
  for (int k = 0; k < L::kCount; ++k) {
    float *x = at.x[k], *y = at.y[k], *z = at.z[k];
    for (int i = 0; !affine && i < L::kPatches; ++i) {
      const vec3 p = transformPoint(m, {x[i], y[i], z[i]});
      x[i] = p.x, y[i] = p.y, z[i] = p.z;
    }
    for (int i = 0; affine && i < L::kPatches; ++i) {
      const float px = x[i], py = y[i], pz = z[i];
      x[i] = (m[0][0] * px + m[1][0] * py) + (m[2][0] * pz + m[3][0]);
      y[i] = (m[0][1] * px + m[1][1] * py) + (m[2][1] * pz + m[3][1]);
      z[i] = (m[0][2] * px + m[1][2] * py) + (m[2][2] * pz + m[3][2]);
    }
    for (int i = 0; i < L::kPatches; ++i) {
      const vec2 raster = camera.raster({x[i], y[i], z[i] < nearest ? nearest : z[i]});
      at.rasterX[k][i] = raster.x, at.rasterY[k][i] = raster.y;
    }
  }
}

template <int kCount, int kPatches>
[[gnu::always_inline]] inline void boundPoints(const float (&at)[kCount][kPatches], float* __restrict lo,
                                               float* __restrict hi) {
  for (int i = 0; i < kPatches; ++i) lo[i] = kInfinity, hi[i] = -kInfinity;
  for (int k = 0; k < kCount; ++k)
    for (int i = 0; i < kPatches; ++i)
      lo[i] = at[k][i] < lo[i] ? at[k][i] : lo[i], hi[i] = hi[i] < at[k][i] ? at[k][i] : hi[i];
}

template <class L>
[[gnu::always_inline]] inline void measureLattice(L& __restrict at, const mat4& m, const Camera& camera, bool asSeen,
                                                  Sizes<L::kPatches>& __restrict out) {
  place(at, m, camera);
  boundPoints(at.x, out.lo[0], out.hi[0]);
  boundPoints(at.y, out.lo[1], out.hi[1]);
  boundPoints(at.z, out.lo[2], out.hi[2]);
  for (auto* longest : {&out.u, &out.v})
    for (int i = 0; i < L::kPatches; ++i)
      longest->px[i] = longest->length[i] = longest->bend_px[i] = 0, longest->least[i] = 1;
  for (int line = 0; line < L::kRow; ++line) {
    measureLine(at, line * L::kRow, 1, camera, asSeen, out.u);
    measureLine(at, line, L::kRow, camera, asSeen, out.v);
  }
  measureArea(at, camera, asSeen, out.area_px2);
}

// The lines of a flat patch are straight, and the longest is one of its edges.
constexpr int kFlatProbes = 1, kCurvedProbes = 4;
/// Length of a triangle along u (its edge v = 1 has no length), as the root mean square, over that of its foot: its
/// cells are smaller on average than the rate asks, and the largest, at its foot, have 1.4 times the area.
constexpr float kTriangle = 0.70710678f;

// Functions with target clones cannot be templates.
TOMALES_HOT void measureHot(Lattice<1, kLanes>& at, const mat4& m, const Camera& camera, bool asSeen,
                            Sizes<kLanes>& out) {
  measureLattice(at, m, camera, asSeen, out);
}
TOMALES_HOT void measureHot(Lattice<4, kLanes>& at, const mat4& m, const Camera& camera, bool asSeen,
                            Sizes<kLanes>& out) {
  measureLattice(at, m, camera, asSeen, out);
}
template <int kProbes>
void measureHot(Lattice<kProbes, 1>& at, const mat4& m, const Camera& camera, bool asSeen, Sizes<1>& out) {
  measureLattice(at, m, camera, asSeen, out);
}

/// An object at a time: its shape, interpolated between `before` and `after` unless `after` is null, and its
/// transformation.
struct Pose {
  const Prim *before, *after;
  float t;
  mat4 cameraFromObject;
};
Pose poseAt(const Object& o, float time) {
  size_t k = 0;
  while (k + 1 < o.shapes.size() && o.shapeTimes[k + 1] <= time) ++k;
  const bool between = k + 1 < o.shapes.size() && time > o.shapeTimes[k];
  return {o.shapes[k].get(), between ? o.shapes[k + 1].get() : nullptr,
          between ? (time - o.shapeTimes[k]) / (o.shapeTimes[k + 1] - o.shapeTimes[k]) : 0.0f,
          o.cameraFromObject.at(time)};
}

/// patchAt(i) returns one of up to kPatches patches; put(i, size) receives its size.
template <int kProbes, int kPatches, class PatchAt, class Put>
void measureSome(const Object& o, const Pose& pose, const Camera& camera, int count, const PatchAt& patchAt,
                 const UvRect& r, const Put& put) {
  using L = Lattice<kProbes, kPatches>;
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
    if (i < count) evaluate(*pose.before, i, data);
    if (i < count && pose.after) {
      evaluate(*pose.after, i, next);
      for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < L::kCount; ++k) data[axis][k] = lerp(data[axis][k], next[axis][k], pose.t);
    }
    for (int k = 0; k < L::kCount; ++k) at.x[k][i] = data[0][k], at.y[k][i] = data[1][k], at.z[k][i] = data[2][k];
  }
  Sizes<kPatches> sizes;
  measureHot(at, pose.cameraFromObject, camera, o.attributes->rasterOrient, sizes);
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

/// Calls measureAt(pose, put of sizes) at each key that counts; out(i) is the size of patch i, the larger of those at
/// the keys. Where a patch is behind the eye or outside of the picture its size is not limited.
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

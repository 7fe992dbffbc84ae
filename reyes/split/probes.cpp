#include "reyes/split/probes.h"

#include <cmath>

namespace tomales {
namespace {

/// Returns the part of a second difference across the line; the part along it is a change of speed only.
inline float bend(float x0, float y0, float x1, float y1, float x2, float y2) {
  const float alongX = x2 - x0, alongY = y2 - y0, secondX = x2 - 2.0f * x1 + x0, secondY = y2 - 2.0f * y1 + y0;
  const float length = std::sqrt(alongX * alongX + alongY * alongY),
              second = std::sqrt(secondX * secondX + secondY * secondY);
  const float across = std::abs(alongX * secondY - alongY * secondX) / length;
  const float finite = across < kInfinity ? across : 0.0f;
  return length > 1e-3f * second ? finite : second;  // otherwise the line turns back on itself
}

/// Returns the least number of chords with which a line encloses an area, however short it is: it may bend round (a
/// meridian) or close on itself (a parallel).
inline int leastCells(float length, float endToEnd) {
  return endToEnd < 0.3f * length ? 6 : endToEnd < 0.8f * length ? 4 : 1;
}

/// Measures the line of points first, first + step, ..., and keeps the larger values in `out`.
template <class L>
[[gnu::always_inline]] inline void measureLine(const L& __restrict at, int first, int step, const Camera& camera,
                                               bool asSeen, typename ProbeSizes<L::kPatches>::Line& __restrict out) {
  constexpr int n = L::kPatches;
  float length_px[size_t{n}] = {}, length[size_t{n}] = {}, chord[size_t{n}];
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
    // With PRMan's Attribute "dice" "rasterorient" 0 a micropolygon is as large as if it faced the camera.
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

/// Computes twice the area in pixels of the triangle at `a` with sides to `b` and `c`; `out` keeps the larger value.
template <class L>
[[gnu::always_inline]] inline void measureCorner(const L& __restrict at, int a, int b, int c, const Camera& camera,
                                                 bool asSeen, float* __restrict out) {
  constexpr int n = L::kPatches;
  float area[size_t{n}];
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

/// Computes the area as if all parts between lines of probes were as large as the largest.
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
      x[i] = p.x;
      y[i] = p.y;
      z[i] = p.z;
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

template <size_t kCount, size_t kPatches>
[[gnu::always_inline]] inline void boundPoints(const float (&at)[kCount][kPatches], float* __restrict lo,
                                               float* __restrict hi) {
  for (size_t i = 0; i < kPatches; ++i) {
    lo[i] = kInfinity;
    hi[i] = -kInfinity;
  }
  for (size_t k = 0; k < kCount; ++k)
    for (size_t i = 0; i < kPatches; ++i)
      lo[i] = at[k][i] < lo[i] ? at[k][i] : lo[i], hi[i] = hi[i] < at[k][i] ? at[k][i] : hi[i];
}

template <class L>
[[gnu::always_inline]] inline void measureAll(L& __restrict at, const mat4& m, const Camera& camera, bool asSeen,
                                              ProbeSizes<L::kPatches>& __restrict out) {
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

}  // namespace

// Functions with target clones cannot be templates.
TOMALES_HOT void measureLattice(ProbeLattice<1, kLanes>& at, const mat4& m, const Camera& camera, bool asSeen,
                                ProbeSizes<kLanes>& out) {
  measureAll(at, m, camera, asSeen, out);
}
TOMALES_HOT void measureLattice(ProbeLattice<4, kLanes>& at, const mat4& m, const Camera& camera, bool asSeen,
                                ProbeSizes<kLanes>& out) {
  measureAll(at, m, camera, asSeen, out);
}
void measureLattice(ProbeLattice<1, 1>& at, const mat4& m, const Camera& camera, bool asSeen, ProbeSizes<1>& out) {
  measureAll(at, m, camera, asSeen, out);
}
void measureLattice(ProbeLattice<4, 1>& at, const mat4& m, const Camera& camera, bool asSeen, ProbeSizes<1>& out) {
  measureAll(at, m, camera, asSeen, out);
}

}  // namespace tomales

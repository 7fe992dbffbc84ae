#include "reyes/split/rate.h"

#include <bit>

namespace tomales {
namespace {

/// How far a chord may leave its arc, at any shading rate: a silhouette's error (docs/decisions/0034).
constexpr float kFlat_px = 0.25f;

/// Chords that a line takes, however short it is, to enclose something: it bends round (a meridian), or closes on itself (a parallel).
int leastCells(float length, float endToEnd) { return endToEnd < 0.3f * length ? 6 : endToEnd < 0.8f * length ? 4 : 1; }

/// The part of a second difference that lies across the line; what lies along it is mere speed.
float bend(const vec2& before, const vec2& at, const vec2& after) {
  const vec2 along = after - before, second = after - 2.0f * at + before;
  const float length = glm::length(along);
  if (!(length > 1e-3f * glm::length(second))) return glm::length(second);  // there and back
  const float across = std::abs(along.x * second.y - along.y * second.x) / length;
  return std::isfinite(across) ? across : 0;
}

/// Longest lines along u and v of the lattice of kProbes x kProbes chords.
template <int kProbes>
PatchSize measureLattice(const Object& o, const Camera& camera, uint32_t patch, const UvRect& r) {
  constexpr int kRow = kProbes + 1, kCount = kRow * kRow;
  float u[kCount], v[kCount], data[12][kCount];
  for (int j = 0, k = 0; j < kRow; ++j)
    for (int i = 0; i < kRow; ++i, ++k) {
      u[k] = lerp(r.u0, r.u1, static_cast<float>(i) / kProbes);
      v[k] = lerp(r.v0, r.v1, static_cast<float>(j) / kProbes);
    }
  o.shape().evaluate(patch, kCount, u, v,
                     {data[0], data[1], data[2], data[3], data[4], data[5], data[6], data[7], data[8], data[9], data[10], data[11]});
  const mat4 m = o.cameraFromObject.at(o.keyTimes.front());
  vec3 p[kCount];
  vec2 raster[kCount];
  PatchSize size;
  for (int k = 0; k < kCount; ++k) {
    p[k] = transformPoint(m, {data[0][k], data[1][k], data[2][k]});
    size.probes.extend(p[k]);
    const vec3 inFront(p[k].x, p[k].y, std::max(p[k].z, camera.nearClip()));
    raster[k] = camera.perspective() ? camera.raster(inFront) : camera.raster(p[k]);
  }
  const bool rasterOrient = o.attributes->rasterOrient;
  for (int line = 0; line < kRow; ++line) {
    float du_px = 0, dv_px = 0, du = 0, dv = 0;
    for (int k = 0; k < kProbes; ++k) {
      const int a = line * kRow + k, b = k * kRow + line;
      const float lu = glm::length(p[a + 1] - p[a]), lv = glm::length(p[b + kRow] - p[b]);
      du += lu;
      dv += lv;
      // Without rasterorient a micropolygon is as large as if it faced the camera (rispec-table 4, dice:rasterorient).
      du_px += rasterOrient ? glm::length(raster[a + 1] - raster[a]) : lu / camera.pixelSize(p[a]);
      if (k > 0) {
        size.u.bend_px = std::max(size.u.bend_px, bend(raster[a - 1], raster[a], raster[a + 1]));
        size.v.bend_px = std::max(size.v.bend_px, bend(raster[b - kRow], raster[b], raster[b + kRow]));
      }
      dv_px += rasterOrient ? glm::length(raster[b + kRow] - raster[b]) : lv / camera.pixelSize(p[b]);
    }
    size.u.px = std::max(size.u.px, du_px), size.v.px = std::max(size.v.px, dv_px);
    size.u.length = std::max(size.u.length, du), size.v.length = std::max(size.v.length, dv);
    const int u0 = line * kRow, v0 = line;
    size.u.least = std::max(size.u.least, leastCells(du, glm::length(p[u0 + kProbes] - p[u0])));
    size.v.least = std::max(size.v.least, leastCells(dv, glm::length(p[v0 + kProbes * kRow] - p[v0])));
  }
  return size;
}

}  // namespace

PatchSize measure(const Object& o, const Camera& camera, uint32_t patch, const UvRect& r) {
  // The lines of a flat patch are straight, and the longest is one of its edges.
  return o.shape().info(patch).planar ? measureLattice<1>(o, camera, patch, r) : measureLattice<4>(o, camera, patch, r);
}

int cells(const LineSize& line, float edge_px, float coarsening, bool binary) {
  constexpr float kLeastOfCoarse = 4;
  // A line that a quarter of it leaves by `bend_px` as a second difference: its n-th part bulges by 2 bend / n^2.
  const float flat = std::min(std::ceil(std::sqrt(2 * line.bend_px / (kFlat_px * coarsening))), 64.0f);
  const float fine = std::ceil(line.px / edge_px), coarse = std::ceil(line.px / (edge_px * coarsening));
  const float n = std::max({coarse, std::min(fine, kLeastOfCoarse), static_cast<float>(line.least), flat});
  const int count = n >= 1.0f ? static_cast<int>(std::min(n, 65536.0f)) : 1;
  return binary ? static_cast<int>(std::bit_ceil(static_cast<unsigned>(count))) : count;
}

}  // namespace tomales

#include "reyes/hide/gathered.h"
#include "reyes/hide/resolve.h"

namespace tomales {
namespace {

/// Returns (u,v) of point x in the triangle p[0..2], whose corners have the parameters at[0..2].
vec2 inTriangle(const vec2 p[3], const vec2 at[3], const vec2& x) {
  const vec2 e = p[1] - p[0], f = p[2] - p[0], g = x - p[0];
  const float area = e.x * f.y - e.y * f.x;
  if (area == 0) return (at[0] + at[1] + at[2]) / 3.0f;
  const float b = (g.x * f.y - g.y * f.x) / area, c = (e.x * g.y - e.y * g.x) / area;
  return at[0] + (at[1] - at[0]) * b + (at[2] - at[0]) * c;
}

}  // namespace

SeenCell seenCell(const GridTable::Entry& entry, const Camera& camera, int cell, const SamplePoint& sample) {
  const Grid& g = entry.grid();
  const RasterGrid& raster = *entry.raster;
  const std::vector<float>& keyTimes = entry.keyTimes;
  const int row = g.nu + 1, a = firstVertex(g, cell);
  const float time = sample.time;
  size_t key = 0;
  while (key + 2 < keyTimes.size() && time >= keyTimes[key + 1]) ++key;
  const size_t next = keyTimes.empty() ? 0 : key + 1, stride = static_cast<size_t>(g.stride());
  const float t = next > key ? (time - keyTimes[key]) / (keyTimes[next] - keyTimes[key]) : 0;
  const auto corner = [&](int v) {
    const size_t from = key * stride + static_cast<size_t>(v), to = next * stride + static_cast<size_t>(v);
    const vec2 at(lerp(raster.x[from], raster.x[to], t), lerp(raster.y[from], raster.y[to], t));
    const float d = lerp(raster.d[from], raster.d[to], t);
    return vec3(raster.defocused ? at + sample.lens * (d - camera.focusKey()) : at, d);
  };
  return {corner(a), corner(a + 1), corner(a + row), corner(a + row + 1)};
}

vec2 positionOnCell(const GridTable::Entry& entry, const Camera& camera, int cell, const SamplePoint& sample) {
  const SeenCell seen = seenCell(entry, camera, cell, sample);
  const vec2 pa(seen.a), pb(seen.b), pc(seen.c), pd(seen.d);
  const vec2 abc[3] = {pa, pb, pc}, abcUv[3] = {{0, 0}, {1, 0}, {0, 1}};
  const vec2 dcb[3] = {pd, pc, pb}, dcbUv[3] = {{1, 1}, {0, 1}, {1, 0}};
  vec2 uv = inTriangle(abc, abcUv, sample.at);
  if (uv.x + uv.y > 1) uv = inTriangle(dcb, dcbUv, sample.at);
  return uv;
}

float depthOnCell(const GridTable::Entry& entry, const Camera& camera, int cell, const SamplePoint& sample) {
  const SeenCell seen = seenCell(entry, camera, cell, sample);
  const vec2 uv = positionOnCell(entry, camera, cell, sample);
  if (uv.x + uv.y <= 1) return seen.a.z + (seen.b.z - seen.a.z) * uv.x + (seen.c.z - seen.a.z) * uv.y;
  return seen.d.z + (seen.c.z - seen.d.z) * (1 - uv.x) + (seen.b.z - seen.d.z) * (1 - uv.y);
}

}  // namespace tomales

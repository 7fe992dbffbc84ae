#include "reyes/hide/sides.h"

#include "reyes/hide/gathered.h"

namespace tomales {
namespace {

float areaOf(const vec2& p, const vec2& q, const vec2& r) {
  const vec2 u = q - p, v = r - p;
  return u.x * v.y - u.y * v.x;
}

/// Returns the depth key of a triangle where a sample meets it; infinity if it misses.
float depthIn(const vec3& p, const vec3& q, const vec3& r, const vec2& at) {
  const float area = areaOf(vec2(p), vec2(q), vec2(r));
  const float b = areaOf(vec2(p), at, vec2(r)) / area, c = areaOf(vec2(p), vec2(q), at) / area;
  if (!(b >= 0 && c >= 0 && b + c <= 1)) return kInfinity;
  return p.z + b * (q.z - p.z) + c * (r.z - p.z);
}

TOMALES_HOT void addSides(const float* x, const float* y, int vertices, int row, float facingSign,
                          int32_t* __restrict sides) {
  constexpr auto kFront = static_cast<int32_t>(Side::Front), kBack = static_cast<int32_t>(Side::Back);
  for (int a = 0, end = vertices - row - 1; a < end; ++a) {
    const float bx = x[a + 1], by = y[a + 1], bcX = x[a + row] - bx, bcY = y[a + row] - by;
    const float abc = facingSign * (bcX * (y[a] - by) - bcY * (x[a] - bx)),
                bdc = facingSign * (bcY * (x[a + row + 1] - bx) - bcX * (y[a + row + 1] - by));
    sides[a] |= ((abc > 0) | (bdc > 0) ? kFront : 0) | ((abc < 0) | (bdc < 0) ? kBack : 0);
  }
}

}  // namespace

float facingSign(const Camera& camera) {
  const vec2 o = camera.raster({0, 0, 1}), x = camera.raster({1, 0, 1}) - o, y = camera.raster({0, 1, 1}) - o;
  return x.x * y.y - x.y * y.x > 0 ? -1.0f : 1.0f;
}

void findSides(const RasterGrid& raster, float facingSign, std::vector<int32_t>& sides) {
  const Grid& g = *raster.grid;
  const bool one = raster.facing != 0 && g.keyCount == 1;
  const Side only = raster.facing == facingSign ? Side::Front : Side::Back;
  sides.assign(static_cast<size_t>(g.stride()), one ? static_cast<int32_t>(only) : 0);
  if (!one) addSides(raster.x.data(), raster.y.data(), g.vertexCount(), g.nu + 1, facingSign, sides.data());
}

Side sideAt(const GridTable::Entry& entry, const Camera& camera, int cell, const SamplePoint& sample) {
  const SeenCell q = seenCell(entry, camera, cell, sample);
  const float abc = areaOf(vec2(q.a), vec2(q.b), vec2(q.c)), bdc = areaOf(vec2(q.b), vec2(q.d), vec2(q.c));
  const float first = depthIn(q.a, q.b, q.c, sample.at), second = depthIn(q.b, q.d, q.c, sample.at);
  const float seen = first == second ? abc + bdc : first < second ? abc : bdc;
  return facingSign(camera) * seen < 0 ? Side::Back : Side::Front;
}

}  // namespace tomales

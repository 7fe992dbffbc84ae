// Projects a grid to raster space. Borders that join a neighbour are pushed out (docs/decisions/0003).
#include "reyes/base/check.h"
#include "reyes/hide/blur_bounds.h"
#include "reyes/hide/borders.h"
#include "reyes/hide/sides.h"

namespace tomales {
namespace {

constexpr float kTrimReach = 2;  // The reach is tested along x and y only, and trim curves run aslant.

/// Vertices of a grid at one key, in camera space.
struct Vertices {
  const float *x, *y, *z;
  int count;
  vec3 at(int v) const { return {x[v], y[v], z[v]}; }
};

/// Tells whether all vertices are seeable. The others belong to cells that are not visible, and are put where they do
/// no harm.
TOMALES_HOT bool toRaster(const Vertices& from, const Camera& camera, float* __restrict x, float* __restrict y,
                          float* __restrict d) {
  const auto project = [&] {
    const float harmless = camera.nearClip();
    int unseeable = 0;
    for (int v = 0; v < from.count; ++v) {
      const vec3 given = from.at(v);
      const bool good = camera.seeable(given);
      unseeable |= good ? 0 : 1;
      const vec3 p(good ? given.x : 0, good ? given.y : 0, good ? given.z : harmless);
      const vec2 at = camera.raster(p);
      x[v] = at.x;
      y[v] = at.y;
      d[v] = camera.depthKey(p.z);
    }
    return unseeable == 0;
  };
  // The compiler vectorises each of the two loops, and not one loop with the choice within it.
  return camera.perspective() ? project() : project();
}

TOMALES_HOT bool allBetween(const Vertices& from, float near, float far) {
  int beyond = 0;
  for (int v = 0; v < from.count; ++v) beyond |= !(from.z[v] >= near && from.z[v] <= far);
  return beyond == 0;
}

bool anyClipped(const Vertices& from, const Camera& camera, bool planes) {
  if (!planes && allBetween(from, camera.nearClip(), camera.farClip())) return false;
  for (int v = 0; v < from.count; ++v)
    if (const vec3 p = from.at(v); camera.seeable(p) && camera.clips(p)) return true;
  return false;
}

TOMALES_HOT void snap(float* __restrict x, float* __restrict y, int count) {
  for (int v = 0; v < count; ++v) {
    x[v] = snapToSubpixel(x[v]);
    y[v] = snapToSubpixel(y[v]);
  }
}

/// Bounds vertices in focus. Each lane of a vector keeps its own extremes, because the compiler does not vectorise a
/// running minimum.
TOMALES_HOT RasterExtent extentOf(const float* x, const float* y, const float* d, int count) {
  RasterExtent e;
  int first = 0;
  if (count >= 2 * kLanes) {
    float lo[3][kLanes], hi[2][kLanes];
    for (int i = 0; i < kLanes; ++i) {
      lo[0][i] = lo[1][i] = lo[2][i] = kInfinity;
      hi[0][i] = hi[1][i] = -kInfinity;
    }
    for (; first + kLanes <= count; first += kLanes)
      for (int i = 0; i < kLanes; ++i) {
        const int v = first + i;
        lo[0][i] = x[v] < lo[0][i] ? x[v] : lo[0][i];
        hi[0][i] = x[v] > hi[0][i] ? x[v] : hi[0][i];
        lo[1][i] = y[v] < lo[1][i] ? y[v] : lo[1][i];
        hi[1][i] = y[v] > hi[1][i] ? y[v] : hi[1][i];
        lo[2][i] = d[v] < lo[2][i] ? d[v] : lo[2][i];
      }
    for (int i = 0; i < kLanes; ++i) {
      e.bound.lo = glm::min(e.bound.lo, vec2(lo[0][i], lo[1][i]));
      e.bound.hi = glm::max(e.bound.hi, vec2(hi[0][i], hi[1][i]));
      e.dMin = std::min(e.dMin, lo[2][i]);
    }
  }
  for (; first < count; ++first) {
    e.bound.extend(vec2(x[first], y[first]));
    e.dMin = std::min(e.dMin, d[first]);
  }
  return e;
}

Bound2 grown(const Bound2& b, float by) { return {b.lo - by, b.hi + by}; }

/// Bounds some of the vertices of `r` at a key, without those that are not seeable; notes whether any is out of focus.
RasterExtent extentOfSeeable(RasterGrid& r, const Camera& camera, int key, int first, int count) {
  const size_t base = static_cast<size_t>(key * r.grid->stride());
  RasterExtent e;
  for (int v = first; v < first + count; ++v) {
    if (!camera.seeable(r.grid->position(key, v))) continue;
    const size_t k = base + static_cast<size_t>(v);
    const vec2 at(r.x[k], r.y[k]), blur = glm::abs(camera.defocus(r.d[k]));
    e.bound.extend(at - blur);
    e.bound.extend(at + blur);
    r.defocused |= std::max(blur.x, blur.y) > 1 / kSubpixels;
    e.dMin = std::min(e.dMin, r.d[k]);
  }
  return e;
}

}  // namespace

std::shared_ptr<const RasterGrid> project(std::shared_ptr<const Grid> grid, const Scene& scene, const Camera& camera,
                                          bool opaque, float zMin, const std::shared_ptr<Pool>& pool) {
  auto r = pool ? std::allocate_shared<RasterGrid>(KeepingPool<RasterGrid>(pool)) : std::make_shared<RasterGrid>();
  const Grid& g = *grid;
  const Object& object = scene.objects[static_cast<size_t>(g.object)];
  const Attributes& attributes = *object.attributes;
  r->grid = std::move(grid);
  // The midpoint filter needs surfaces behind opaque ones.
  r->opaque = opaque && scene.options.depthFilter != DepthFilter::Midpoint;
  r->matte = attributes.matte;
  r->inSolid = object.solid >= 0;
  r->keepsUnseen = !attributes.cull.hidden && !r->inSolid;
  const float facing = object.flipsNormal ? -facingSign(camera) : facingSign(camera);
  if (attributes.sides == 1 && !r->inSolid) r->facing = facing;
  r->detail = attributes.detail;
  r->smooth = attributes.interpolation == ShadingInterpolation::Smooth && !r->grid->round;
  if (std::find(g.kept.begin(), g.kept.end(), Kept::Part) != g.kept.end()) {
    CHECK_EQ(g.pieceCount(), 1);
    r->trim = &object.shape();
  }
  // The tail lets blocks of micropolygons be read across the end.
  const size_t stride = static_cast<size_t>(g.stride()), size = stride * static_cast<size_t>(g.keyCount) + 2 * kLanes;
  for (PooledVector<float>* axis : {&r->x, &r->y, &r->d}) *axis = PooledVector<float>(size, 0.0f, pool.get());
  planBorders(*r, object, camera);
  // Transparent surfaces would show such a wide overlap.
  const float mostOfDisplaced_px = opaque && attributes.displacement && object.displacementBound > 0
                                       ? borderReach_px(object.displacementBound)
                                       : 0.0f;
  const int pieces = g.pieceCount(), count = g.verticesOfPiece();
  if (pieces > 1) r->ofPiece.resize(static_cast<size_t>(pieces));
  for (int key = 0; key < g.keyCount; ++key) {
    const size_t base = stride * static_cast<size_t>(key);
    float *x = r->x.data() + base, *y = r->y.data() + base, *d = r->d.data() + base;
    const Vertices vertices{g.P(key, 0), g.P(key, 1), g.P(key, 2), g.vertexCount()};
    const bool allSeeable = toRaster(vertices, camera, x, y, d);
    if (!r->inSolid) r->clipped |= anyClipped(vertices, camera, !scene.options.clippingPlanes.empty());
    if (r->trim) r->trimReach_px = std::max(r->trimReach_px, kLeastReach_px + kTrimReach * deviation_px(g, x, y));
    pushBorders(*r, mostOfDisplaced_px, facing, x, y);
    snap(x, y, g.vertexCount());
    for (int p = 0; p < pieces; ++p) {
      const int first = p * count;
      auto extent = !allSeeable || camera.defocuses() ? extentOfSeeable(*r, camera, key, first, count)
                                                      : extentOf(x + first, y + first, d + first, count);
      if (!r->lines.empty()) extent.bound = grown(extent.bound, kLineReach_px);
      if (pieces > 1) r->ofPiece[static_cast<size_t>(p)].extend(extent);
      r->extend(extent);
    }
  }
  if ((r->inSolid || r->keepsUnseen) && zMin < kInfinity) r->dMin = std::min(r->dMin, camera.leastDepthKey(zMin));
  r->trimReach_px = std::min(r->trimReach_px, borderReach_px(0));
  CHECK_EQ(pieces > 1 && (g.keyCount > 1 || camera.defocuses() || r->inSolid), false);
  if (g.keyCount > 1 || r->defocused) r->blur = boundBlur(*r, camera, pool.get());
  return r;
}

}  // namespace tomales

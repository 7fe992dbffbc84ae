// Projects a grid to raster space. Borders that join a neighbour are pushed out (docs/decisions/0003).
#include "reyes/base/check.h"
#include "reyes/hide/blur_bounds.h"
#include "reyes/hide/lattice.h"
#include "reyes/hide/sides.h"

namespace tomales {
namespace {

constexpr float kLeastSlant = 0.05f;  // the least slant, for faces that are seen edge on
// A neighbour with edges twice as long has four times the sagitta of ours.
constexpr float kReach = 4;
constexpr float kMinReach_px = 2 / kLattice;
// Factor on how far displaced borders reach out, for those that turn away from the eye, and the same share of a pixel:
// past the horizon more would show as a dark line around the body.
constexpr float kShareAway = 0.1f;
constexpr float kTrimReach = 2;  // The reach is tested along x and y only, and trim curves run aslant.

/// One border of a piece as vertex indices: first + k * step for k in 0..count; the inner neighbour is `inward` away.
struct Border {
  PatchEdge edge;
  int first, step, inward, count;
};

/// Returns how far the border's curve may lie from its chord at vertex k, in pixels. The second difference of points h
/// apart on a curve of curvature c is h^2 c, its sagitta h^2 c / 8.
float sagitta_px(const Grid& g, const float* x, const float* y, const Border& b, int k) {
  const int v = b.first + std::clamp(k, 1, std::max(1, b.count - 1)) * b.step;
  if (b.count > 1) {
    const vec2 before{x[v] - x[v - b.step], y[v] - y[v - b.step]}, after{x[v + b.step] - x[v], y[v + b.step] - y[v]};
    const float one = glm::length(before), other = glm::length(after), longer = std::max(one, other);
    if (!(dot(before, after) > 0)) return glm::length(after - before) / 8;
    // Only the turn counts: unevenly spaced points of a straight border, as near the tip of a paraboloid, open no
    // crack.
    const float turn = std::abs(before.x * after.y - before.y * after.x) / (one * other);
    return turn * 2 / (one + other) * longer * longer / 8;
  }
  // A single chord does not show its curve, but the normals turn as the tangents do.
  const int w = b.first;
  const vec3 turn = normalizeOr(g.normal(v), vec3(0)) - normalizeOr(g.normal(w), vec3(0));
  return glm::length(vec2(x[v] - x[w], y[v] - y[w])) * glm::length(turn) / 8;
}

float deviationAlong(const Grid& g, const float* x, const float* y, const Border& line) {
  float most = 0;
  for (int k = 0; k <= line.count; ++k) most = std::max(most, sagitta_px(g, x, y, line, k));
  return most;
}

/// Returns how far the surface may lie from the grid's cells, in pixels: the sagitta along u and v, and the fold of a
/// twisted cell.
float deviation_px(const Grid& g, const float* x, const float* y) {
  const int row = g.nu + 1;
  float most = 0;
  for (int j = 0; j <= g.nv; ++j) most = std::max(most, deviationAlong(g, x, y, {kEdgeV0, j * row, 1, row, g.nu}));
  for (int i = 0; i <= g.nu; ++i) most = std::max(most, deviationAlong(g, x, y, {kEdgeU0, i, row, 1, g.nv}));
  for (int j = 0; j < g.nv; ++j)
    for (int i = 0; i < g.nu; ++i) {
      const int a = j * row + i, b = a + 1, c = a + row, d = c + 1;
      most = std::max(most, glm::length(vec2(x[a] - x[b] - x[c] + x[d], y[a] - y[b] - y[c] + y[d])) / 4);
    }
  return most;
}

/// Sine of the angle between a direction and the border at vertex k.
float slantOf(const vec2& direction, const float* x, const float* y, const Border& b, int k) {
  const int before = b.first + std::max(k - 1, 0) * b.step, after = b.first + std::min(k + 1, b.count) * b.step;
  const vec2 along{x[after] - x[before], y[after] - y[before]};
  const float length = glm::length(along);
  return length > 0 ? std::abs(along.x * direction.y - along.y * direction.x) / length : 1.0f;
}

float longestEdge_px(const float* x, const float* y, const Border& b) {
  float longest = 0;
  for (int k = 0; k < b.count; ++k) {
    const int v = b.first + k * b.step, w = v + b.step;
    longest = std::max(longest, glm::length(vec2(x[w] - x[v], y[w] - y[v])));
  }
  return longest;
}

/// Sign of the raster area of the cell at vertex k of a border, u before v.
float areaSign(const float* x, const float* y, const Border& b, int k) {
  const int v = b.first + k * b.step, before = k < b.count ? v : v - b.step, after = before + b.step, in = v + b.inward;
  const vec2 along{x[after] - x[before], y[after] - y[before]}, inward{x[in] - x[v], y[in] - y[v]};
  const float turn = inward.x * along.y - inward.y * along.x;
  return b.edge == kEdgeU0 || b.edge == kEdgeV1 ? turn : -turn;
}

/// least_px: how far the border reaches out where it looks straight; this is more than kMinReach_px for a displaced
/// border.
void pushBorder(const Grid& g, const Border& b, const float* x, const float* y, float least_px, float facing,
                std::vector<vec2>& push) {
  const float most_px = std::max(borderReach_px(0), least_px);
  const float away_px = least_px > kMinReach_px ? kShareAway * std::max(1.0f, least_px) : most_px;
  for (int k = 0; k <= b.count; ++k) {
    const int v = b.first + k * b.step;
    const vec2 outward{x[v] - x[v + b.inward], y[v] - y[v + b.inward]};
    const float length = glm::length(outward);
    if (!(length > 0)) continue;
    const float reach = std::clamp(kReach * sagitta_px(g, x, y, b, k), least_px, most_px);
    // Vertices move along the lattice, so that the other borders stay where they are, until the border itself has moved
    // by `reach`.
    const float slant = std::max(slantOf(outward / length, x, y, b, k), kLeastSlant);
    const bool faces = facing * areaSign(x, y, b, k) > 0;
    push[static_cast<size_t>(v)] += outward * (std::min(reach / slant, faces ? most_px : away_px) / length);
  }
}

/// A displaced border that neighbours sample at other places may be anywhere within a micropolygon of theirs:
/// `mostOfDisplaced_px` limits the reach; it is 0 for others. facing: RasterGrid::facing of a one-sided surface.
void pushBorders(const Grid& g, float mostOfDisplaced_px, float facing, float* x, float* y) {
  const auto ends = [](const Grid::Piece& p) { return (p.openEdges & kAllEdges) == kAllEdges; };
  if (std::all_of(g.pieces.begin(), g.pieces.end(), ends)) return;
  const int row = g.nu + 1;
  static thread_local std::vector<vec2> push;
  push.assign(static_cast<size_t>(g.vertexCount()), vec2(0));
  int first = 0;
  for (const Grid::Piece& p : g.pieces) {
    const Border borders[] = {{kEdgeU0, first, row, 1, g.nv},
                              {kEdgeU1, first + g.nu, row, -1, g.nv},
                              {kEdgeV0, first, 1, row, g.nu},
                              {kEdgeV1, first + g.nv * row, 1, -row, g.nu}};
    for (const Border& b : borders)
      if (!(p.openEdges & b.edge))
        pushBorder(g, b, x, y, std::max(kMinReach_px, std::min(mostOfDisplaced_px, longestEdge_px(x, y, b))), facing,
                   push);
    first += g.verticesOfPiece();
  }
  for (size_t v = 0; v < push.size(); ++v) x[v] += push[v].x, y[v] += push[v].y;
}

/// Vertices of a grid at one key, in camera space.
struct Vertices {
  const float *x, *y, *z;
  int count;
  vec3 at(int v) const { return {x[v], y[v], z[v]}; }
};

/// Are all vertices seeable? Those that are not belong to cells that nobody sees, and are put where they do no harm.
TOMALES_HOT bool toRaster(const Vertices& from, const Camera& camera, float* __restrict x, float* __restrict y,
                          float* __restrict d) {
  const vec3 harmless(0, 0, camera.nearClip());
  int unseeable = 0;
  for (int v = 0; v < from.count; ++v) {
    const vec3 given = from.at(v);
    const bool good = camera.seeable(given);
    unseeable |= !good;
    const vec3 p(good ? given.x : harmless.x, good ? given.y : harmless.y, good ? given.z : harmless.z);
    const vec2 at = camera.raster(p);
    x[v] = at.x, y[v] = at.y, d[v] = camera.depthKey(p.z);
  }
  return unseeable == 0;
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
  for (int v = 0; v < count; ++v) x[v] = snapToLattice(x[v]), y[v] = snapToLattice(y[v]);
}

/// Bounds vertices in focus. Each lane of a vector keeps its own extremes, because the compiler does not vectorise a
/// running minimum.
TOMALES_HOT RasterExtent extentOf(const float* x, const float* y, const float* d, int count) {
  RasterExtent e;
  int first = 0;
  if (count >= 2 * kLanes) {
    float lo[3][kLanes], hi[2][kLanes];
    for (int i = 0; i < kLanes; ++i) lo[0][i] = lo[1][i] = lo[2][i] = kInfinity, hi[0][i] = hi[1][i] = -kInfinity;
    for (; first + kLanes <= count; first += kLanes)
      for (int i = 0; i < kLanes; ++i) {
        const int v = first + i;
        lo[0][i] = x[v] < lo[0][i] ? x[v] : lo[0][i], hi[0][i] = x[v] > hi[0][i] ? x[v] : hi[0][i];
        lo[1][i] = y[v] < lo[1][i] ? y[v] : lo[1][i], hi[1][i] = y[v] > hi[1][i] ? y[v] : hi[1][i];
        lo[2][i] = d[v] < lo[2][i] ? d[v] : lo[2][i];
      }
    for (int i = 0; i < kLanes; ++i) {
      e.bound.lo = glm::min(e.bound.lo, vec2(lo[0][i], lo[1][i])),
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
    r.defocused |= std::max(blur.x, blur.y) > 1 / kLattice;
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
  // Transparent surfaces would show an overlap that wide.
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
    if (r->trim) r->trimReach_px = std::max(r->trimReach_px, kMinReach_px + kTrimReach * deviation_px(g, x, y));
    pushBorders(g, mostOfDisplaced_px, facing, x, y);
    snap(x, y, g.vertexCount());
    for (int p = 0; p < pieces; ++p) {
      const int first = p * count;
      const auto extent = !allSeeable || camera.defocuses() ? extentOfSeeable(*r, camera, key, first, count)
                                                            : extentOf(x + first, y + first, d + first, count);
      if (pieces > 1) r->ofPiece[static_cast<size_t>(p)].extend(extent);
      r->extend(extent);
    }
  }
  if (r->inSolid && zMin < kInfinity) r->dMin = std::min(r->dMin, camera.leastDepthKey(zMin));
  r->trimReach_px = std::min(r->trimReach_px, borderReach_px(0));
  CHECK_EQ(pieces > 1 && (g.keyCount > 1 || camera.defocuses() || r->inSolid), false);
  if (g.keyCount > 1 || r->defocused) r->blur = boundBlur(*r, camera, pool.get());
  return r;
}

}  // namespace tomales

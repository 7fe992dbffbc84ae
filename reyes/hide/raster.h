// Micropolygons against samples. Private to the hider.
// A micropolygon abcd (a b over c d in (u,v)) is the triangles abc and bdc: the diagonal bc is fixed.
// A sample is inside a triangle if it lies on the inner side of each edge. Every edge is evaluated from its
// lexicographically smaller end, so both neighbours get the same value with opposite signs, and the value
// zero belongs to the right of the edge seen from that end: as if every sample were moved by (e^2, -e) for an
// infinitesimal e. Vertices of still grids and samples lie on a lattice (kLattice), which makes the values
// exact in float for micropolygons up to about 4 px, so that a fan round a vertex neither misses a sample nor
// hits it twice.
#pragma once
#include <bit>

#include "reyes/hide/lattice.h"
#include "reyes/hide/samples.h"

// Clones of a hot function vectorise only what is inlined into them.
#define TOMALES_KERNEL __attribute__((always_inline))

namespace tomales {

/// Far below the distance of two values that an edge function takes: `value > -kTiny` says `value >= 0`, as a
/// number that a vector can choose, and survives threads that flush denormals.
constexpr float kTiny = 1e-30f;

/// What the loops need of a grid besides itself.
struct RasterJob {
  const RasterGrid& raster;
  const GridTable& grids;
  uint32_t firstCell;
  const std::vector<float>& keyTimes;  ///< Fractions of the shutter.
  const Camera& camera;
  SampleBuffer& out;
};

/// Grids with one motion key, in focus.
void rasterizeStill(const RasterJob& job);
/// Grids that move or are out of focus: a sample meets the vertices where they are at its time through its
/// point of the lens.
void rasterizeBlurred(const RasterJob& job);

/// Sides 1: does the cell turn its RISpec normal away from the eye?
inline bool turnedAway(const RasterJob& job, int a) {
  const Grid& g = *job.raster.grid;
  const int row = g.nu + 1;
  const vec3 n = g.normal(a) + g.normal(a + 1) + g.normal(a + row) + g.normal(a + row + 1);
  const vec3 p =
      g.position(0, a) + g.position(0, a + 1) + g.position(0, a + row) + g.position(0, a + row + 1);
  return job.camera.perspective() ? dot(n, p) > 0 : n.z > 0;
}

/// Depth keys of kLanes samples that a micropolygon covers; kInfinity elsewhere.
struct alignas(64) LaneDepths {
  float d[kLanes];
};

/// Gives samples to a cell: nearest hit if opaque, one more layer otherwise. `lane`: the group's first of the
/// pixel. Returns true if the pixel's far depth may have changed.
TOMALES_KERNEL inline bool merge(const RasterJob& job, const LaneDepths& hit, size_t pixel, int lane,
                                 uint32_t cell) {
  const size_t first = pixel * static_cast<size_t>(job.out.lanes) + static_cast<size_t>(lane);
  float* depth = job.out.depth.data() + first;
  uint32_t* owner = job.out.cell.data() + first;
  if (job.raster.inSolid) {
    for (int s = 0; s < kLanes; ++s)
      if (hit.d[s] < kInfinity && depth[s] > -kInfinity)
        job.out.crossings.push_back(
            {static_cast<uint32_t>(pixel), cell, static_cast<uint32_t>(lane + s), hit.d[s]});
    return false;
  }
  if (!job.raster.opaque) {
    for (int s = 0; s < kLanes; ++s)
      if (hit.d[s] <= depth[s])
        job.out.layers.push_back(
            {static_cast<uint32_t>(pixel), cell, static_cast<uint32_t>(lane + s), hit.d[s]});
    return false;
  }
  int nearer = 0, ties = 0;
#pragma GCC unroll 1  // Else unrolled into scalars before it could become one vector.
  for (int s = 0; s < kLanes; ++s) {
    nearer |= hit.d[s] < depth[s];
    ties |= hit.d[s] == depth[s];
  }
  if (ties)
    for (int s = 0; s < kLanes; ++s)
      if (hit.d[s] == depth[s] && job.grids.precedes(cell, owner[s])) owner[s] = cell;
  if (!nearer) return false;
#pragma GCC unroll 1
  for (int s = 0; s < kLanes; ++s) {
    const bool won = hit.d[s] < depth[s];
    depth[s] = won ? hit.d[s] : depth[s];
    owner[s] = won ? cell : owner[s];
  }
  return true;
}

/// Takes away hits of samples, from `lane` on in the pattern of pixel (x, y), that the level of detail or clipping planes
/// keep from seeing the grid.
void askSamples(const RasterJob& job, int x, int y, size_t lane, LaneDepths& hit);

/// Takes away what trim curves cut from a cell: hits of samples from `lane` on in the pattern of pixel (x, y).
void cutAway(const RasterJob& job, uint32_t cell, int x, int y, size_t lane, LaneDepths& hit);
/// What trim curves leave of a cell of the job's grid.
inline Kept keptOf(const RasterJob& job, int cell) {
  return job.raster.trim ? job.raster.grid->kept[static_cast<size_t>(cell)] : Kept::All;
}

/// Integers in the order of floats, and back: the maximum of integers is a vector reduction without
/// fast-math.
inline int32_t ordered(float f) {
  const int32_t bits = std::bit_cast<int32_t>(f);
  return bits ^ ((bits >> 31) & 0x7fffffff);
}
inline float fromOrdered(int32_t i) { return std::bit_cast<float>(i ^ ((i >> 31) & 0x7fffffff)); }

/// The greatest depth of a pixel.
TOMALES_KERNEL inline float farthest(const float* depth, int lanes) {
  int32_t most = ordered(-kInfinity);
  for (int g = 0; g < lanes; g += kLanes) {
#pragma GCC unroll 1
    for (int s = 0; s < kLanes; ++s) most = std::max(most, ordered(depth[g + s]));
  }
  return fromOrdered(most);
}

/// Calls cover(x, y, offset of the samples in the pattern, LaneDepths&) for every group of lanes of the
/// pixels that a cell's bound touches and that do not hide it yet, and merges.
template <class Cover>
TOMALES_KERNEL inline void forPixels(const RasterJob& job, const vec2& lo, const vec2& hi, float dMin,
                                     uint32_t cell, const Cover& cover) {
  SampleBuffer& out = job.out;
  const PixelRect pixels = out.touched(lo, hi);
  if (job.raster.inSolid) dMin = job.raster.dMin;
  const bool asks = job.raster.clipped || !job.raster.detail.whole();
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      const size_t pixel = out.pixelIndex(x, y);
      if (dMin > out.far[pixel]) continue;
      const size_t first = pixel * static_cast<size_t>(out.lanes);
      bool changed = false;
      for (int g = 0; g < out.lanes; g += kLanes) {
        LaneDepths hit;
        const size_t at = out.patternAt[pixel] + static_cast<size_t>(g);
        cover(x, y, at, hit);
        if (asks) askSamples(job, x, y, at, hit);
        changed |= merge(job, hit, pixel, g, cell);
      }
      if (changed) out.far[pixel] = farthest(out.depth.data() + first, out.lanes);
    }
}

}  // namespace tomales

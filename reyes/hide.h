// Verb: grids -> DeepTile. Samples one bucket: every pixel has a stratified, reproducible set of sample positions and
// times, and each micropolygon that covers a sample competes for it by depth. Opaque surfaces keep the nearest; others
// keep all in front of the nearest opaque one, nearest first. Edges: a sample exactly on an edge shared by two
// micropolygons belongs to one of them (no gap, no double hit). Along the border of a grid that joins a neighbour,
// micropolygons reach over by the sagitta of the border, so that different rates leave no crack (docs/decisions/0003).
// Threads: one Hider a bucket, each on its own thread; grids are shared and read only.
#pragma once
#include <map>

#include "reyes/deep.h"
#include "reyes/grid.h"

namespace tomales {

/// Positions of the samples of every pixel: one of 256 precomputed stratified patterns, chosen by a hash of the pixel.
class SamplePattern {
 public:
  SamplePattern(int xSamples, int ySamples, bool jitter, uint32_t seed, const Aperture& aperture = {});
  int count() const { return count_; }
  int padded() const { return padded_; }
  int patternCount() const { return patterns_; }  ///< Enough not to be seen to repeat.
  int patternOf(int x, int y) const;
  const float* x(int pattern) const { return of(x_, pattern); }  ///< In [0,1) inside the pixel; padded() floats.
  const float* y(int pattern) const { return of(y_, pattern); }
  const float* time(int pattern) const { return of(time_, pattern); }    ///< In [0,1) of the shutter.
  const float* lensX(int pattern) const { return of(lensX_, pattern); }  ///< In the unit disk, over the aperture.
  const float* lensY(int pattern) const { return of(lensY_, pattern); }
  const float* detail(int pattern) const {
    return of(detail_, pattern);
  }  ///< In [0,1): what DetailShare divides; those of a pixel are stratified.

 private:
  const float* of(const AlignedVector<float>& values, int pattern) const {
    return values.data() + static_cast<ptrdiff_t>(pattern) * padded_;
  }
  int count_, padded_, patterns_;
  uint32_t seed_;
  AlignedVector<float> x_, y_, time_, lensX_, lensY_, detail_;
};

struct BlurBounds;

/// Where something is seen, over the shutter and the lens.
struct RasterExtent {
  Bound2 bound;
  float dMin = kInfinity;
  void extend(const RasterExtent& e) {
    bound.extend(e.bound.lo), bound.extend(e.bound.hi);
    dMin = std::min(dMin, e.dMin);
  }
};

/// Vertices of a grid in raster space, made once a grid by `project` and shared by the buckets.
struct RasterGrid : RasterExtent {
  std::shared_ptr<const Grid> grid;
  bool opaque = true;  ///< Hides what is behind it.
  bool matte = false;
  float facing = 0;  ///< Seen are triangles abc and bdc (reyes/hide/raster.h) whose raster area has this sign; 0: all.
  DetailShare detail;      ///< Only samples of this share see it.
  bool clipped = false;    ///< Some vertex is cut off by the near or far plane or a ClippingPlane.
  bool inSolid = false;    ///< Its hits are crossings for reyes/hide/solids.cpp, and hide nothing before.
  bool smooth = false;     ///< ShadingInterpolation
  bool defocused = false;  ///< Some vertex moves visibly with the point of the lens.
  std::shared_ptr<const BlurBounds> blur;  ///< Null if still and in focus.
  PooledVector<float> x, y, d;  ///< Raster x, y and depth key (Camera::depthKey): keyCount * stride each, then a tail
                                ///< to read blocks across the end; borders pushed out.
  std::vector<RasterExtent> ofPiece;  ///< Empty: one piece.
  const Prim* trim = nullptr;         ///< Asked what trim curves leave of Grid::kept cells; null: nothing is cut.
  float trimReach_px = 0;             ///< What is left reaches this much farther, to meet what a neighbour leaves.
};
/// Pre: every vertex of a cell that Grid::kept keeps is Camera::seeable; several pieces are still, in focus and belong
/// to no solid. zMin: nearest camera z of the solid that the grid belongs to. pool: where it is kept. opaque: by its
/// shaders; what may stand before the midpoint of two surfaces hides nothing all the same.
std::shared_ptr<const RasterGrid> project(std::shared_ptr<const Grid> grid, const Scene& scene, const Camera& camera,
                                          bool opaque, float zMin = kInfinity,
                                          const std::shared_ptr<Pool>& pool = nullptr);

/// What the hider cannot know, or shows badly.
struct HideDoubts {
  /// Pixels in which either of two objects, the first with the lower number, is seen by chance: in a quarter of the
  /// samples or more they lie at the same place, as far as depths can tell. Of what is opaque, still and in focus.
  std::map<std::pair<int, int>, int> samePlaces;
  /// Visible micropolygons by object: those that are round, still and in focus, and turn so far that their outline has
  /// corners; and all.
  struct Turns {
    int64_t turned = 0, all = 0;
  };
  std::map<int, Turns> turns;
};

class Hider {
 public:
  /// All but `rect` must outlive the Hider.
  Hider(const Scene& scene, const Camera& camera, const SamplePattern& pattern, const PixelRect& rect);
  ~Hider();
  /// True if every sample in the bound is already hidden by something opaque nearer than zMin (camera space).
  bool hidden(const Bound2& raster, float zMin) const;
  /// The same of what has been projected: insert() would find nothing to do.
  bool hidden(const RasterExtent& extent) const;
  void insert(const std::shared_ptr<const RasterGrid>& grid);
  /// Collects visible micropolygons into points to shade. The Hider is spent.
  DeepTile resolve(HideDoubts* doubts = nullptr);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales

// Verb: grids -> DeepTile. It samples one bucket: every pixel has a stratified, reproducible set of sample positions
// and times, and each micropolygon that covers a sample competes for it by depth. Of opaque surfaces the nearest is
// kept; of transparent ones all in front of the nearest opaque one, nearest first.
// Edges: a sample exactly on an edge shared by two micropolygons belongs to one of them (no gap, no double hit). Along
// the border of a grid that joins a neighbour, micropolygons reach over by the sagitta of the border, so that different
// rates leave no crack (docs/decisions/0003).
// Threads: one Hider for each bucket, each on its own thread; grids are shared and read only.
#pragma once
#include <map>

#include "reyes/deep.h"
#include "reyes/grid.h"

namespace tomales {

/// Positions of the samples of every pixel: one of some precomputed stratified patterns, chosen by a hash of the pixel.
class SamplePattern {
 public:
  SamplePattern(int xSamples, int ySamples, bool jitter, uint32_t seed, const Aperture& aperture = {});
  int count() const { return count_; }
  int padded() const { return padded_; }
  int patternCount() const { return patterns_; }
  int patternOf(int x, int y) const;
  /// Returns numbers in [0,1) inside the pixel; padded() floats.
  const float* x(int pattern) const { return of(x_, pattern); }
  const float* y(int pattern) const { return of(y_, pattern); }
  const float* time(int pattern) const { return of(time_, pattern); }  ///< Returns numbers in [0,1) of the shutter.
  /// Returns positions in the unit disk, over the aperture.
  const float* lensX(int pattern) const { return of(lensX_, pattern); }
  const float* lensY(int pattern) const { return of(lensY_, pattern); }
  /// Returns numbers in [0,1), compared with DetailShare; those of a pixel are stratified.
  const float* detail(int pattern) const { return of(detail_, pattern); }

 private:
  const float* of(const AlignedVector<float>& values, int pattern) const {
    return values.data() + static_cast<ptrdiff_t>(pattern) * padded_;
  }
  int count_, padded_, patterns_;
  uint32_t seed_;
  AlignedVector<float> x_, y_, time_, lensX_, lensY_, detail_;
};

struct BlurBounds;

/// Bounds over the shutter and the lens, in raster space and in depth keys.
struct RasterExtent {
  Bound2 bound;
  float dMin = kInfinity;
  void extend(const RasterExtent& e) {
    bound.extend(e.bound.lo);
    bound.extend(e.bound.hi);
    dMin = std::min(dMin, e.dMin);
  }
};

/// A straight line at which a piece ends, in raster space. Its ends are those of the whole edge of a surface, so a
/// neighbour that has them too ends at the same line, whatever its own vertices are.
struct BorderLine {
  vec2 from{0}, to{0};
  bool none() const { return from == to; }
};

/// Vertices of a grid in raster space, made once for each grid by `project` and shared by the buckets.
struct RasterGrid : RasterExtent {
  std::shared_ptr<const Grid> grid;
  bool opaque = true;  ///< True if it hides what is behind it.
  bool matte = false;
  /// Triangles abc and bdc (reyes/hide/raster.h) are seen if their raster area has this sign; 0 if all are seen.
  float facing = 0;
  DetailShare detail;    ///< Only samples of this share see it.
  bool clipped = false;  ///< Some vertex is cut off by the near or far plane or a ClippingPlane.
  /// True if its hits are crossings for reyes/hide/solids.cpp, which hide nothing until they are resolved.
  bool inSolid = false;
  /// Micropolygons become points to shade even where no sample sees them (Attribute "cull" "hidden" 0).
  bool keepsUnseen = false;
  bool smooth = false;                     ///< ShadingInterpolation is "smooth".
  bool defocused = false;                  ///< Some vertex moves visibly with the point of the lens.
  std::shared_ptr<const BlurBounds> blur;  ///< Null if the grid is still and in focus.
  /// Raster x, y and depth key (Camera::depthKey) with the borders pushed out: keyCount * stride floats each. A tail
  /// follows, so that a block may be read across the end.
  PooledVector<float> x, y, d;
  std::vector<RasterExtent> ofPiece;  ///< Extent of each piece; empty: there is one piece.
  /// PatchEdge bits of each piece: borders that were pushed out, as neighbours may have other vertices there; empty:
  /// none.
  std::vector<uint8_t> reaching;
  /// Four lines of each piece, in the order of PatchEdge. They end its cells there instead of the cells' own edges.
  /// Empty: there are none.
  std::vector<BorderLine> lines;
  const Prim* trim = nullptr;  ///< The shape whose trim curves cut Kept::Part cells (Grid::kept); null: nothing is cut.
  float trimReach_px = 0;      ///< Trimmed surfaces reach this much farther, to meet their neighbours.
};
/// Takes a grid to raster space. Pre: every vertex of a cell that Grid::kept keeps is Camera::seeable; a grid of
/// several pieces is still, in focus and not part of a solid.
///   opaque  true if its shaders make it so; with the midpoint filter it hides nothing all the same
///   zMin    counts as its nearest z if it is part of a solid or keeps unseen micropolygons, so that no bucket skips it
///           too early: the nearest z of the solid, or -infinity, which nothing hides
///   pool    provides the memory; may be null
std::shared_ptr<const RasterGrid> project(std::shared_ptr<const Grid> grid, const Scene& scene, const Camera& camera,
                                          bool opaque, float zMin = kInfinity,
                                          const std::shared_ptr<Pool>& pool = nullptr);

/// Counts of samples whose result is uncertain or badly shown, from which warnings are made.
struct HideDiagnostics {
  /// Numbers of pixels in which chance decides which of two objects is seen: in a quarter of the samples or more their
  /// depths differ by less than their error. The first object of a pair has the lower number. Only opaque, still
  /// surfaces in focus count.
  std::map<std::pair<int, int>, int> samePlaces;
  /// Visible micropolygons by object: `turned` counts those that are still and in focus and turn so far that a round
  /// outline has corners; `all` counts all.
  struct Turns {
    int64_t turned = 0, all = 0;
  };
  std::map<int, Turns> turns;
};

class Hider {
 public:
  /// All arguments but `rect` must outlive the Hider.
  Hider(const Scene& scene, const Camera& camera, const SamplePattern& pattern, const PixelRect& rect);
  ~Hider();
  /// Tells whether every sample in the bound is already hidden by something opaque that is nearer than zMin (camera
  /// space).
  bool hidden(const Bound2& raster, float zMin) const;
  /// Tells the same of a projected grid. If it is hidden, insert() would find nothing to do.
  bool hidden(const RasterExtent& extent) const;
  /// Lets the micropolygons of a grid compete for the samples that they cover.
  void insert(const std::shared_ptr<const RasterGrid>& grid);
  /// Collects visible micropolygons into points to shade. The Hider cannot be used after it.
  DeepTile resolve(HideDiagnostics* diagnostics = nullptr);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales

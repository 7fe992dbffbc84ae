// Verb: Scene -> sub-patches small enough to dice, each with its raster bound. The steps are bound, cull, measure,
// halve. A piece that crosses the near plane is halved until its micropolygons are small there. Halving also ends for
// pieces that it cannot make small, because each patch has a budget of visits. Coarse pieces inherit the rest of it.
// The result depends on the camera and on ShadingRate, never on buckets, crop or threads. Threads: pure except for the
// counters and the log.
#pragma once
#include <optional>
#include <span>

#include "reyes/base/stats.h"
#include "reyes/base/stop.h"
#include "reyes/scene.h"

namespace tomales {

/// A rectangle of a patch that one grid can hold, and the size of that grid.
struct SubPatch {
  int object;
  uint32_t patch;
  UvRect rect;
  int nu, nv;
  Bound2 raster;            ///< Conservative raster bound over the shutter, displacement included.
  float zMin;               ///< Nearest camera z, over the shutter, displacement included.
  bool crossesEye = false;  ///< A part of it lies nearer than Camera::eyePlane, whose micropolygons must be left out.
  int depth = 0;            ///< Number of halvings of its patch.
  bool coarse = false;      ///< It is too large for a grid: splitPiece() splits it further.
  int64_t visits = 0;       ///< Budget of pieces that splitPiece() may visit.
  bool round = false;       ///< A small disk, to be shown as one round cell (Grid::round).
};

/// A bound over the shutter that includes displacement and defocus.
struct Placement {
  Bound2 raster;
  float zMin;  ///< Depth in camera space.
};

/// A box of object space that moves.
struct MovingBox {
  const Bound3& box;
  const Motion& cameraFromObject;
  const std::vector<float>& keyTimes;
  float margin;  ///< Displacement may leave the box by this, in camera space.
};
/// Says whether the far plane and clipping planes hide what lies beyond them. For parts of a solid they do not, because
/// it needs all of its surfaces.
enum class Clipping : uint8_t { On, Off };
/// Bounds a box as the camera sees it over the shutter. `window`: raster pixels that have samples. Returns nothing if
/// no point of the box can be seen in the window.
std::optional<Placement> placeBox(const MovingBox& moving, const Camera& camera, const PixelRect& window,
                                  Clipping clipping = Clipping::On);

/// Tells whether a piece depends on its own vertices alone. That is so without motion, defocus, displacement and other
/// parts of a solid.
inline bool standsStillInFocus(const Object& o, const Camera& camera) {
  return o.keyTimes.size() == 1 && !camera.defocuses() && o.solid < 0 && !o.attributes->displacement;
}

/// Tells whether a patch of very many pieces is split at once, or left in coarse pieces where that is safe. All of a
/// frame's pieces at once would take memory in proportion to its area.
enum class Splitting : uint8_t { Wholly, Lazily };

/// What all splitting of a frame has in common. The references outlive it.
struct SplitContext {
  const Scene& scene;
  const Camera& camera;
  PixelRect window;  ///< The raster pixels that have samples: pieces wholly outside are culled.
  Stats& stats;
  Log& log;
  StopToken stop{};
};
/// Splits some patches of an object. The order is: first dots, which need not be measured, then the other patches as
/// given, and within a patch by place.
std::vector<SubPatch> splitPatches(const SplitContext& context, int object, std::span<const uint32_t> patches,
                                   Splitting splitting = Splitting::Wholly);
/// Returns the next pieces of a coarse one, split lazily. Once no piece is coarse, they are the same as with
/// Splitting::Wholly.
std::vector<SubPatch> splitPiece(const SplitContext& context, const SubPatch& coarse);

/// A tree of boxes in object space around all of an object's shapes over time. Patches are sorted along a space-filling
/// curve, so that a run of them is compact in any model. Level 0 has a box for each run of kLeaf patches. Each level
/// above has one box for kFan boxes of the level below, and the last level has a single box. Instances share the tree.
class PatchTree {
 public:
  static constexpr uint32_t kLeaf = 64, kFan = 16;
  explicit PatchTree(const std::vector<PrimPtr>& shapes, StopToken stop = {});

  uint32_t patchCount() const { return static_cast<uint32_t>(order_.size()); }
  uint32_t top() const { return static_cast<uint32_t>(levels_.size()) - 1; }
  uint32_t count(uint32_t level) const { return static_cast<uint32_t>(levels_[level].size()); }
  const Bound3& box(uint32_t level, uint32_t index) const { return levels_[level][index]; }
  /// Returns the number of patches in a box of a level; the last box of a level may have fewer.
  static size_t patchesOfBox(uint32_t level) {
    size_t patches = kLeaf;
    while (level-- > 0) patches *= kFan;
    return patches;
  }
  /// Returns the patches in a box.
  std::span<const uint32_t> patches(uint32_t level, uint32_t index) const {
    const size_t most = patchesOfBox(level), first = index * most;
    return std::span(order_).subspan(first, std::min(most, order_.size() - first));
  }

 private:
  std::vector<uint32_t> order_;
  std::vector<std::vector<Bound3>> levels_;
};

}  // namespace tomales

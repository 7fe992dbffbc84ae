// Verb: Scene -> sub-patches small enough to dice, each with its raster bound. Bound, cull, judge, halve; a piece that
// crosses the near plane is halved until its micropolygons are small there. What no halving makes small ends too: a
// patch has a budget of visits, of which coarse pieces inherit what is left. Depends on the camera and on ShadingRate,
// never on buckets, crop or threads. Threads: pure but for the counters and the log.
#pragma once
#include <atomic>
#include <optional>
#include <span>

#include "reyes/base/stats.h"
#include "reyes/scene.h"

namespace tomales {

/// A rectangle of a patch that one grid can hold, and the size of that grid.
struct SubPatch {
  int object;
  uint32_t patch;
  UvRect rect;
  int nu, nv;
  Bound2 raster;  ///< Conservative, over the shutter, displacement included.
  float zMin;     ///< Nearest camera z, likewise.
  bool crossesEye =
      false;            ///< Some of it lies nearer than Camera::eyePlane, and micropolygons there are to be left out.
  int depth = 0;        ///< Halvings of its patch.
  bool coarse = false;  ///< Too large for a grid: splitPiece() goes on with it,
  int64_t visits = 0;   ///< and may look at so many pieces.
  bool round = false;   ///< A small disk, which is to be shown as one round cell (Grid::round).
};

/// Where something may be seen, over the shutter, displacement and defocus included.
struct Placement {
  Bound2 raster;
  float zMin;  ///< Camera space.
};

/// Of a box in the space of `cameraFromObject`, at `keyTimes`, that displacement may leave by `margin` (camera space).
/// `window`: raster pixels that have samples. Nothing: no point of it can be seen there; not `clipped`: no line meets
/// it there.
std::optional<Placement> placeBox(const Bound3& box, const Motion& cameraFromObject, const std::vector<float>& keyTimes,
                                  float margin, const Camera& camera, const PixelRect& window, bool clipped = true);

/// Without motion, defocus, displacement and the other parts of a solid, nothing of a piece depends on more than its
/// own vertices.
inline bool standsStillInFocus(const Object& o, const Camera& camera) {
  return o.keyTimes.size() == 1 && !camera.defocuses() && o.solid < 0 && !o.attributes->displacement;
}

/// Whether a patch of very many pieces is split at once, or left in coarse pieces where that is safe: a frame's pieces
/// all at once would take memory in proportion to its area.
enum class Splitting : uint8_t { Wholly, Lazily };
/// Set from elsewhere: what is going on may end at once, with any result. Null: never.
using StopFlag = const std::atomic<bool>*;

/// Splits some patches of an object; what lies wholly outside the window is culled. Order: dots, which need not be
/// measured, then the others, as given, then by place.
std::vector<SubPatch> splitPatches(const Scene& scene, int object, std::span<const uint32_t> patches,
                                   const Camera& camera, const PixelRect& window, Stats& stats, Log& log,
                                   Splitting splitting = Splitting::Wholly, StopFlag stop = nullptr);
/// The next pieces of a coarse one, lazily. In the end they are those of splitting wholly.
std::vector<SubPatch> splitPiece(const Scene& scene, const SubPatch& coarse, const Camera& camera,
                                 const PixelRect& window, Stats& stats, Log& log, StopFlag stop = nullptr);

/// Boxes in object space of all that an object's shapes are over time. Patches are put in order along a curve that
/// fills space, so that a run of them is compact, however a model scatters them: level 0 has a box for each run of
/// kLeaf patches, a level above one for kFan boxes below, the last a single one. Instances share it.
class PatchTree {
 public:
  static constexpr uint32_t kLeaf = 64, kFan = 16;
  explicit PatchTree(const std::vector<PrimPtr>& shapes, StopFlag stop = nullptr);

  uint32_t patchCount() const { return static_cast<uint32_t>(order_.size()); }
  uint32_t top() const { return static_cast<uint32_t>(levels_.size()) - 1; }
  uint32_t count(uint32_t level) const { return static_cast<uint32_t>(levels_[level].size()); }
  const Bound3& box(uint32_t level, uint32_t index) const { return levels_[level][index]; }
  /// The patches in a box of level 0.
  std::span<const uint32_t> patches(uint32_t index) const {
    const size_t first = size_t{index} * kLeaf;
    return std::span(order_).subspan(first, std::min<size_t>(kLeaf, order_.size() - first));
  }

 private:
  std::vector<uint32_t> order_;
  std::vector<std::vector<Bound3>> levels_;
};

}  // namespace tomales

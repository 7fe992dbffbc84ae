// The sub-patches of a frame and the grids made of them. A grid is diced by the first bucket that needs it, shared, and
// freed when the last bucket that its bound touches is done (docs/decisions/0008).
// Threads: acquire and release are concurrent.
#pragma once
#include <mutex>

#include "reyes/hide.h"
#include "reyes/shade.h"
#include "reyes/split.h"

namespace tomales {

class GridStore {
 public:
  GridStore(std::vector<SubPatch> pieces, const Scene& scene, const Camera& camera, const ShadingSystem& shading, Stats& stats,
            Log& log);

  const SubPatch& piece(uint32_t i) const { return pieces_[i]; }
  size_t size() const { return pieces_.size(); }
  void addUser(uint32_t i) { ++slots_[i].users; }  ///< While buckets are being filled, by one thread.

  /// Dices on first call. Null: the grid cannot be hidden (a vertex at or behind the eye).
  std::shared_ptr<const RasterGrid> acquire(uint32_t i);
  void release(uint32_t i);

 private:
  struct Slot {
    std::mutex mutex;
    std::shared_ptr<const RasterGrid> grid;
    bool made = false;
    int users = 0;
  };
  std::shared_ptr<const RasterGrid> make(const SubPatch& piece);
  void keepPeak(int64_t bytes);  ///< memory_bytes.grids is the most that was alive at once.

  std::vector<SubPatch> pieces_;
  std::vector<Slot> slots_;
  Counter live_bytes_{0};
  const Scene& scene_;
  const Camera& camera_;
  const ShadingSystem& shading_;
  Stats& stats_;
  Log& log_;
};

}  // namespace tomales

// Light and rays are asked for the points of a batch alone: their neighbours, which serve derivatives, share the
// answers.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

class Primary {
 public:
  Primary(const Batch& batch, const TmGrid* g) : all_(g), grid_(*g) {
    if (!batch.points || g->count <= batch.points->count()) return;
    grid_.count = batch.points->count(), grid_.padded = padded(grid_.count);
  }
  const TmGrid* grid() const { return &grid_; }

  /// Copies what was answered to the active neighbours. Null arrays are left alone.
  template <class T>
  void spread(T* out) const {
    if (!out) return;
    for (int i = grid_.count; i < all_->count; ++i)
      if (all_->active[i]) out[i] = out[i % grid_.count];
  }
  void spread(TmVec3 out) const { spread(out.x), spread(out.y), spread(out.z); }

 private:
  const TmGrid* all_;
  TmGrid grid_;
};

template <class Body>
void forActive(const TmGrid* g, const Body& body) {
  for (int i = 0; i < g->count; ++i)
    if (g->active[i]) body(i);
}

/// How much of a light counts at each point: where it is lit, what one of its outputs __nondiffuse and __nonspecular
/// leaves. Null: all.
inline void setShares(int n, const uint8_t* lit, const float* without, float* share) {
  for (int i = 0; i < n; ++i) share[i] = lit[i] ? (without ? 1 - without[i] : 1.0f) : 0.0f;
}

inline Batch& batchOf(void* host) { return *static_cast<Batch*>(host); }

}  // namespace tomales

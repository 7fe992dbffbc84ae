// Light and rays are computed only at the points of a batch; their neighbours, which are there for derivatives, get
// copies of the answers.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

class Primary {
 public:
  Primary(const Batch& batch, const TmGrid* g) : all_(g), grid_(*g) {
    if (!batch.points || g->count <= batch.points->count()) return;
    grid_.count = batch.points->count();
    grid_.padded = padded(grid_.count);
  }
  const TmGrid* grid() const { return &grid_; }

  /// Copies the answers to the active neighbours. Null arrays are left alone.
  template <class T>
  void spread(T* out) const {
    if (!out) return;
    for (int i = grid_.count; i < all_->count; ++i)
      if (all_->active[i]) out[i] = out[i % grid_.count];
  }
  void spread(TmVec3 out) const {
    spread(out.x);
    spread(out.y);
    spread(out.z);
  }

 private:
  const TmGrid* all_;
  TmGrid grid_;
};

template <class Body>
void forActive(const TmGrid* g, const Body& body) {
  for (int i = 0; i < g->count; ++i)
    if (g->active[i]) body(i);
}

/// Sets the share of a light that counts at each point: 1 minus its output __nondiffuse or __nonspecular where it is
/// lit, and 0 elsewhere. A null `without` stands for 0.
inline void setShares(int n, const uint8_t* lit, const float* without, float* share) {
  for (int i = 0; i < n; ++i) share[i] = lit[i] ? (without ? 1 - without[i] : 1.0f) : 0.0f;
}

inline Batch& batchOf(void* host) { return *static_cast<Batch*>(host); }

}  // namespace tomales

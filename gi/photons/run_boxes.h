// Private to gi: boxes around runs of things that follow each other, and around runs of these boxes, up to one. They
// are tight if neighbours in the order are neighbours in space. Threads: visits are concurrent.
#pragma once
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

class RunBoxes {
 public:
  RunBoxes() = default;
  /// boundOf(i): the box of thing i.
  template <class BoundOf>
  RunBoxes(size_t count, const BoundOf& boundOf) : count_(count) {
    if (count_ > 0) levels_.push_back(around(count_, boundOf));
    while (!levels_.empty() && levels_.back().size() > 1)
      levels_.push_back(around(levels_.back().size(), [&](size_t i) -> const Bound3& { return levels_.back()[i]; }));
  }

  /// Calls f(i) in ascending order for the things of each run whose box meets(box), as all boxes above it must.
  template <class Meets, class F>
  void visit(const Meets& meets, const F& f) const {
    if (!levels_.empty()) visit(levels_.size() - 1, 0, meets, f);
  }

 private:
  static constexpr size_t kFan = 8;

  template <class BoundOf>
  static std::vector<Bound3> around(size_t count, const BoundOf& boundOf) {
    std::vector<Bound3> out((count + kFan - 1) / kFan);
    for (size_t i = 0; i < count; ++i) out[i / kFan].extend(boundOf(i));
    return out;
  }

  template <class Meets, class F>
  void visit(size_t level, size_t box, const Meets& meets, const F& f) const {
    if (!meets(levels_[level][box])) return;
    const size_t first = box * kFan, below = level == 0 ? count_ : levels_[level - 1].size();
    for (size_t i = first; i < std::min(first + kFan, below); ++i)
      if (level == 0)
        f(i);
      else
        visit(level - 1, i, meets, f);
  }

  size_t count_ = 0;
  std::vector<std::vector<Bound3>> levels_;
};

}  // namespace tomales

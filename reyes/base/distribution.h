// Random choices in proportion to weights. Threads: const members may be called concurrently.
#pragma once
#include <algorithm>
#include <vector>

namespace tomales {

class Distribution {
 public:
  void add(double weight) { sums_.push_back(sums_.back() + weight); }
  size_t count() const { return sums_.size() - 1; }
  double total() const { return sums_.back(); }
  double weight(size_t i) const { return sums_[i + 1] - sums_[i]; }

  /// Returns the index that x in [0,1) selects, and rescales x to its place within that index's share, [0,1]. Pre:
  /// total() > 0.
  size_t pick(double& x) const {
    const double at = x * total();
    const auto next = std::upper_bound(sums_.begin() + 1, sums_.end() - 1, at);
    const auto i = static_cast<size_t>(next - sums_.begin()) - 1;
    const double part = weight(i);
    x = part > 0 ? std::clamp((at - sums_[i]) / part, 0.0, 1.0) : 0.5;
    return i;
  }

 private:
  std::vector<double> sums_{0.0};
};

}  // namespace tomales

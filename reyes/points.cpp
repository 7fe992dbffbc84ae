#include "reyes/points.h"

namespace tomales {

int ShadePoints::add(uint32_t key) {
  const int index = count();
  keys_.push_back(key);
  if (static_cast<size_t>(index) >= channels_[0].size())
    for (auto& c : channels_) c.resize(static_cast<size_t>(padded(std::max(index + 1, 2 * index))), 0.0f);
  return index;
}

void ShadePoints::reserve(int n) {
  keys_.reserve(static_cast<size_t>(n));
  for (auto& c : channels_) c.reserve(static_cast<size_t>(padded(n)));
}

void ShadePoints::shrink() {
  for (auto& c : channels_) {
    c.resize(static_cast<size_t>(padded(count())));
    c.shrink_to_fit();
  }
  keys_.shrink_to_fit();
}

void ShadePoints::clear() { keys_.clear(); }

void ShadedPoints::resize(int count) {
  for (int k = 0; k < 3; ++k) {
    Ci[k].assign(static_cast<size_t>(padded(count)), 0.0f);
    Oi[k].assign(static_cast<size_t>(padded(count)), 0.0f);
  }
}

}  // namespace tomales

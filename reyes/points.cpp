#include "reyes/points.h"

namespace tomales {

int ShadePoints::add(SampleName name) {
  const int index = count();
  names_.push_back(name);
  if (index == capacity_) setCapacity(2 * index + 1);
  if (index % kLanes == 0)
    for (int c = 0; c < channels_; ++c) std::fill_n(channel(c) + index, kLanes, 0.0f);
  return index;
}

void ShadePoints::reserve(int points) {
  names_.reserve(static_cast<size_t>(points));
  if (points > capacity_) setCapacity(points);
}

void ShadePoints::assign(const ShadePoints& from, int begin, int end) {
  const int n = end - begin;
  names_.assign(from.names_.begin() + begin, from.names_.begin() + end);
  if (n > capacity_) setCapacity(n);
  for (int c = 0; c < channels_; ++c) {
    std::copy(from.channel(c) + begin, from.channel(c) + end, channel(c));
    std::fill(channel(c) + n, channel(c) + padded(n), 0.0f);
  }
}

void ShadePoints::shrink() {
  if (padded(count()) < capacity_) setCapacity(count());
  names_.shrink_to_fit();
}

void ShadePoints::setCapacity(int points) {
  const int wanted = padded(points);
  UnsetVector<float> block(static_cast<size_t>(channels_) * static_cast<size_t>(wanted));
  for (int c = 0; c < channels_; ++c)
    std::copy_n(channel(c), std::min({capacity_, wanted, padded(count())}),
                block.data() + static_cast<size_t>(c) * static_cast<size_t>(wanted));
  block_ = std::move(block);
  capacity_ = wanted;
}

void ShadePoints::clear() { names_.clear(); }

void ShadedPoints::resize(int count) {
  for (int k = 0; k < 3; ++k) {
    Ci[k].assign(static_cast<size_t>(padded(count)), 0.0f);
    Oi[k].assign(static_cast<size_t>(padded(count)), 0.0f);
    airCi[k].clear();
    airOi[k].clear();
  }
}

}  // namespace tomales

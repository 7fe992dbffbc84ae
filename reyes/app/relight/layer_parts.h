// The parts of a layer, and the edit that each of them shows. Threads: plain object.
#pragma once
#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tomales {

class LayerParts {
 public:
  explicit LayerParts(size_t parts = 0) : held_(parts, 0) {}

  /// Sets the edit, by its text, that all parts shall show.
  void want(const std::string& edit) {
    if (numbers_.size() > kMostKnown)
      std::erase_if(numbers_, [&](const auto& known) { return std::ranges::count(held_, known.second) == 0; });
    const auto [known, isNew] = numbers_.try_emplace(edit, last_ + 1);
    if (isNew) ++last_;
    wanted_ = known->second;
  }
  /// Returns the number of the wanted edit, from 1. It is the same for the same text, and greater for one that was not
  /// known.
  uint32_t wanted() const { return wanted_; }
  bool isOld(size_t part) const { return held_[part] != wanted_; }
  bool areOld() const { return old() > 0; }
  size_t old() const { return held_.size() - static_cast<size_t>(std::ranges::count(held_, wanted_)); }
  size_t count() const { return held_.size(); }
  /// Returns the share of the parts that still have to be shaded.
  double shareOld() const { return static_cast<double>(old()) / static_cast<double>(count()); }
  void take(size_t part, uint32_t number) { held_[part] = number; }
  /// Says that all parts have been lost.
  void forgetAll() { std::ranges::fill(held_, 0u); }

 private:
  static constexpr size_t kMostKnown = 64;
  std::map<std::string, uint32_t> numbers_;
  uint32_t wanted_ = 0, last_ = 0;
  std::vector<uint32_t> held_;
};

}  // namespace tomales

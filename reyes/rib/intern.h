// Makes equal values share one object: shading groups objects that share their attributes, and RIB repeats itself.
#pragma once
#include <array>
#include <memory>

namespace tomales::rib {

/// Remembers the latest distinct values; that suffices for scenes that alternate between a few materials.
template <class T>
class Interner {
 public:
  /// Returns a known equal value, or else `value` itself, which is known from now on.
  std::shared_ptr<T> operator()(std::shared_ptr<T> value) {
    for (const std::shared_ptr<T>& known : recent_)
      if (known && (known == value || *known == *value)) return known;
    recent_[next_++ % recent_.size()] = value;
    return value;
  }

 private:
  std::array<std::shared_ptr<T>, 16> recent_;
  size_t next_ = 0;
};

}  // namespace tomales::rib

// Noun: shapes of very many patches that are used in another order than they lie in memory. Fetching a particle from
// memory can take longer than computing with it.
#pragma once
#include <cstdint>

namespace tomales {

class Scattered {
 public:
  /// Fetches a patch that will be used soon.
  virtual void prefetch(uint32_t patch) const = 0;

 protected:
  ~Scattered() = default;
};

/// patchOf(item) returns the patch that is used next.
template <class Shape, class Items, class PatchOf>
void prefetch(const Shape& shape, const Items& items, const PatchOf& patchOf) {
  if (const auto* scattered = dynamic_cast<const Scattered*>(&shape))
    for (const auto& item : items) scattered->prefetch(patchOf(item));
}

}  // namespace tomales

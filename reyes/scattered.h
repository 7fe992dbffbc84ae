// Noun: shapes of very many patches that are asked for in another order than they lie in memory. Of a
// particle the way from memory took longer than all that was computed of it.
#pragma once
#include <cstdint>

namespace tomales {

class Scattered {
 public:
  /// Something will soon be asked of the patch.
  virtual void prefetch(uint32_t patch) const = 0;

 protected:
  ~Scattered() = default;
};

/// patchOf(item): what will be asked of the shape next.
template <class Shape, class Items, class PatchOf>
void prefetch(const Shape& shape, const Items& items, const PatchOf& patchOf) {
  if (const auto* scattered = dynamic_cast<const Scattered*>(&shape))
    for (const auto& item : items) scattered->prefetch(patchOf(item));
}

}  // namespace tomales

#include "reyes/deep.h"

namespace tomales {

size_t DeepTile::bytes() const {
  size_t n = facets.capacity() * sizeof(Facet) + fragments.capacity() * sizeof(Fragment) + pixels.capacity() * sizeof(DeepPixel);
  for (const ShadePoints& b : batches) n += b.bytes();
  for (const ShadedPoints& s : shaded) n += (6 + s.variables.size()) * s.Ci[0].capacity() * sizeof(float);
  return n;
}

void DeepTile::shrink() {
  for (ShadePoints& b : batches) b.shrink();
  facets.shrink_to_fit(), fragments.shrink_to_fit(), pixels.shrink_to_fit();
}

}  // namespace tomales

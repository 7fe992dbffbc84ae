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

void DeepTile::forgetPoints() {
  for (Facet& facet : facets) facet.edge = edgeOf(facet);
  for (ShadePoints& batch : batches) batch = ShadePoints(batch.group(), 0);
}

void DeepFrame::layOutTiles() {
  tiles.resize(static_cast<size_t>(columns) * static_cast<size_t>(rows));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      PixelRect& r = tiles[static_cast<size_t>(row) * static_cast<size_t>(columns) + static_cast<size_t>(column)].rect;
      r.x0 = padded.x0 + column * bucketWidth;
      r.y0 = padded.y0 + row * bucketHeight;
      r.x1 = std::min(r.x0 + bucketWidth, padded.x1);
      r.y1 = std::min(r.y0 + bucketHeight, padded.y1);
    }
}

}  // namespace tomales

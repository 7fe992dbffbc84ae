#include "reyes/deep.h"

namespace tomales {

size_t DeepTile::bytes() const {
  size_t n = facets.capacity() * sizeof(Facet) + fragments.capacity() * sizeof(Fragment) +
             pixels.capacity() * sizeof(DeepPixel);
  for (const ShadePoints& b : batches) n += b.bytes();
  for (const ShadedPoints& s : shaded)
    n += ((6 + s.variables.size()) * s.Ci[0].capacity() + 6 * s.airCi[0].capacity()) * sizeof(float);
  return n;
}

void DeepTile::shrink() {
  for (ShadePoints& b : batches) b.shrink();
  facets.shrink_to_fit();
  fragments.shrink_to_fit();
  pixels.shrink_to_fit();
}

DeepTile withoutPoints(const DeepTile& tile) {
  DeepTile out;
  out.rect = tile.rect;
  for (const ShadePoints& batch : tile.batches) out.batches.emplace_back(batch.group(), 0);
  out.facets = tile.facets;
  for (Facet& facet : out.facets) facet.edge = tile.edgeOf(facet);
  out.fragments = tile.fragments;
  out.pixels = tile.pixels;
  out.shaded = tile.shaded;
  return out;
}

void DeepTile::forgetPoints() {
  for (Facet& facet : facets) facet.edge = edgeOf(facet);
  for (ShadePoints& batch : batches) batch = ShadePoints(batch.group(), 0);
}

PixelRect DeepFrame::rectOf(size_t tile) const {
  const int x0 = padded.x0 + static_cast<int>(tile % static_cast<size_t>(columns)) * bucketWidth;
  const int y0 = padded.y0 + static_cast<int>(tile / static_cast<size_t>(columns)) * bucketHeight;
  return {x0, y0, std::min(x0 + bucketWidth, padded.x1), std::min(y0 + bucketHeight, padded.y1)};
}

void DeepFrame::hold(int first, int last) {
  const auto width = static_cast<size_t>(columns);
  const int heldTo = firstRow + static_cast<int>(width > 0 ? tiles.size() / width : 0);
  std::vector<DeepTile> now(width * static_cast<size_t>(last - first));
  for (size_t i = 0; i < now.size(); ++i) {
    const size_t index = i + width * static_cast<size_t>(first);
    const int row = static_cast<int>(index / width);
    if (row >= firstRow && row < heldTo)
      now[i] = std::move(tile(index));
    else
      now[i].rect = rectOf(index);
  }
  tiles = std::move(now);
  firstRow = first;
}

TileReader readerOf(const DeepFrame& frame) {
  return [&frame](size_t index) {
    const DeepTile& tile = frame.tiles[index];
    return tile.pixels.empty() ? nullptr : std::shared_ptr<const DeepTile>(std::shared_ptr<void>(), &tile);
  };
}

}  // namespace tomales

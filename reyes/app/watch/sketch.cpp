#include "reyes/app/watch/sketch.h"

#include "reyes/base/parallel.h"

namespace tomales {
namespace {

/// A corner of the lattice, and the point of a reduced tile that it sees.
struct Corner {
  int x, y;
  size_t batch;
  int point;
};

void append(const ShadePoints& from, int i, ShadePoints& to) {
  const int k = to.add(from.name(i));
  for (int c = 0; c < from.channelCount(); ++c) to.channel(c)[k] = from.channel(c)[i];
}

int roundUp(int value, int stride) { return (value + stride - 1) / stride * stride; }

std::vector<Corner> cornersOf(const DeepTile& tile, int stride, DeepTile& reduced) {
  for (const ShadePoints& batch : tile.batches)
    reduced.batches.emplace_back(batch.group(), batch.primvarFloats(), batch.hasSteps());
  std::vector<Corner> out;
  for (int y = roundUp(tile.rect.y0, stride); y < tile.rect.y1; y += stride)
    for (int x = roundUp(tile.rect.x0, stride); x < tile.rect.x1; x += stride) {
      const DeepPixel& pixel = tile.pixel(x, y);
      if (pixel.count == 0) continue;
      const Facet& facet = tile.facets[tile.fragments[pixel.first].facet];
      if (facet.matte) continue;
      const auto b = static_cast<size_t>(facet.batch);
      out.push_back({x, y, b, reduced.batches[b].count()});
      append(tile.batches[b], facet.point[0], reduced.batches[b]);
    }
  return out;
}

void fill(Image& image, const PixelRect& square, const vec3& color, float alpha) {
  for (int y = std::max(square.y0, image.originY); y < std::min(square.y1, image.originY + image.height); ++y)
    for (int x = std::max(square.x0, image.originX); x < std::min(square.x1, image.originX + image.width); ++x) {
      float* pixel = image.at(x - image.originX, y - image.originY);
      pixel[0] = color.x;
      pixel[1] = color.y;
      pixel[2] = color.z;
      pixel[3] = alpha;
    }
}

}  // namespace

Image sketch(const DeepFrame& layout, const TileReader& tiles, int stride, const Scene& scene,
             const ShadingSystem& shading, const ShadeContext& context, const std::atomic<bool>& cancelled) {
  const PixelRect& crop = layout.crop;
  Image out{crop.width(), crop.height(), {"R", "G", "B", "A"},      {},
            crop.x0,      crop.y0,       scene.options.xResolution, scene.options.yResolution};
  out.pixels.resize(static_cast<size_t>(out.width) * static_cast<size_t>(out.height) * out.channels.size());
  parallelFor(layout.tileCount(), 1, [&](size_t t, size_t) {
    const auto tile = cancelled ? nullptr : tiles(t);
    if (!tile) return;
    DeepTile reduced;
    const std::vector<Corner> corners = cornersOf(*tile, stride, reduced);
    shadeTile(reduced, scene, shading, context);
    for (const Corner& c : corners) {
      const vec3 opacity = reduced.shaded[c.batch].opacity(c.point);
      fill(out, {c.x, c.y, c.x + stride, c.y + stride}, reduced.shaded[c.batch].color(c.point),
           (opacity.x + opacity.y + opacity.z) / 3);
    }
  });
  expose(out, scene.options);
  runImager(out, shading);
  return out;
}

}  // namespace tomales

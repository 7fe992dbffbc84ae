#include "reyes/app/watch/sketch.h"

#include "reyes/base/parallel.h"

namespace tomales {
namespace {

void append(const ShadePoints& from, int i, ShadePoints& to) {
  const int k = to.add(from.name(i));
  for (int c = 0; c < from.channelCount(); ++c) to.channel(c)[k] = from.channel(c)[i];
}

/// Returns the first number from `value` on that is `origin` plus a multiple of `stride`. Pre: value is at least
/// origin.
int roundUp(int value, int origin, int stride) { return origin + (value - origin + stride - 1) / stride * stride; }

/// Returns the batch of a tile for points of this group.
size_t batchFor(const ShadePoints& points, DeepTile& tile) {
  const auto found = std::ranges::find(tile.batches, points.group(), &ShadePoints::group);
  if (found != tile.batches.end()) return static_cast<size_t>(found - tile.batches.begin());
  tile.batches.emplace_back(points.group(), points.primvarFloats(), points.hasSteps());
  return tile.batches.size() - 1;
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

void addCorners(const DeepTile& tile, int stride, const ivec2& origin, DeepTile& reduced, std::vector<Corner>& out) {
  // A multiple of the stride may lie before the origin.
  const ivec2 first = origin - stride * ((origin - ivec2(tile.rect.x0, tile.rect.y0)) / stride + 1);
  for (int y = roundUp(tile.rect.y0, first.y, stride); y < tile.rect.y1; y += stride)
    for (int x = roundUp(tile.rect.x0, first.x, stride); x < tile.rect.x1; x += stride) {
      const DeepPixel& pixel = tile.pixel(x, y);
      if (pixel.count == 0) continue;
      const Facet& facet = tile.facets[tile.fragments[pixel.first].facet];
      if (facet.matte) continue;
      const ShadePoints& batch = tile.batches[static_cast<size_t>(facet.batch)];
      const size_t b = batchFor(batch, reduced);
      out.push_back({x, y, b, reduced.batches[b].count()});
      append(batch, facet.point[0], reduced.batches[b]);
    }
}

Image sketch(const DeepFrame& layout, const TileReader& tiles, int stride, const Scene& scene,
             const ShadingSystem& shading, const ShadeContext& context, StopToken stop) {
  const PixelRect& crop = layout.crop;
  Image out{crop.width(), crop.height(), {"R", "G", "B", "A"},      {},
            crop.x0,      crop.y0,       scene.options.xResolution, scene.options.yResolution};
  out.pixels.resize(static_cast<size_t>(out.width) * static_cast<size_t>(out.height) * out.channels.size());
  parallelFor(layout.tileCount(), 1, [&](size_t t, size_t) {
    const auto tile = stop.requested() ? nullptr : tiles(t);
    if (!tile) return;
    DeepTile reduced;
    std::vector<Corner> corners;
    addCorners(*tile, stride, ivec2(0), reduced, corners);
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

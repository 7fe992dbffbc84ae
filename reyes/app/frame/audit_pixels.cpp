#include "reyes/app/frame/audit_pixels.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

#include "reyes/base/parallel.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/frame.h"

namespace tomales {
namespace {

auto placeOf(const AuditPixel& p) { return std::tuple(p.order, p.y, p.x); }
bool isEarlier(const AuditPixel& a, const AuditPixel& b) { return placeOf(a) < placeOf(b); }

/// Keeps the `count` pixels with the lowest order.
void keepFirst(std::vector<AuditPixel>& pixels, size_t count) {
  if (pixels.size() <= count) return;
  std::nth_element(pixels.begin(), pixels.begin() + static_cast<ptrdiff_t>(count), pixels.end(), isEarlier);
  pixels.erase(pixels.begin() + static_cast<ptrdiff_t>(count), pixels.end());
}

/// Copies what some pixels of a tile need.
class PixelCopy {
 public:
  PixelCopy(const DeepTile& from, const PixelRect& rect) : from_(from) {
    to_.rect = rect;
    to_.pixels.resize(static_cast<size_t>(rect.width()) * static_cast<size_t>(rect.height()));
  }

  void add(const ivec2& at) {
    const DeepPixel& pixel = from_.pixel(at.x, at.y);
    const PixelRect& r = to_.rect;
    to_.pixels[static_cast<size_t>((at.y - r.y0) * r.width() + (at.x - r.x0))] = {
        static_cast<uint32_t>(to_.fragments.size()), pixel.count};
    for (uint32_t f = pixel.first; f < pixel.first + pixel.count; ++f) {
      Fragment fragment = from_.fragments[f];
      fragment.facet = copyOf(fragment.facet);
      to_.fragments.push_back(fragment);
    }
  }
  DeepTile take() { return std::move(to_); }

 private:
  uint32_t copyOf(uint32_t facet) {
    const auto [known, isNew] = facets_.try_emplace(facet, static_cast<uint32_t>(to_.facets.size()));
    if (isNew) to_.facets.push_back(copy(from_.facets[facet]));
    return known->second;
  }

  Facet copy(Facet facet) {
    const ShadePoints& points = from_.batches[static_cast<size_t>(facet.batch)];
    const auto [batch, isNew] = batches_.try_emplace(facet.batch, static_cast<int>(to_.batches.size()));
    if (isNew) to_.batches.emplace_back(points.group(), points.primvarFloats(), points.hasSteps());
    ShadePoints& copies = to_.batches[static_cast<size_t>(batch->second)];
    for (int& point : facet.point) {
      const auto [known, isFirst] = points_.try_emplace(std::pair(facet.batch, point), copies.count());
      if (isFirst) {
        copies.add(points.name(point));
        for (int c = 0; c < points.channelCount(); ++c) copies.channel(c)[known->second] = points.channel(c)[point];
      }
      point = known->second;
    }
    facet.batch = batch->second;
    return facet;
  }

  const DeepTile& from_;
  DeepTile to_;
  std::map<uint32_t, uint32_t> facets_;
  std::map<int, int> batches_;
  std::map<std::pair<int, int>, int> points_;
};

std::vector<AuditPixel> pixelsOfTile(const DeepTile& tile, const PixelRect& seen, size_t count, uint32_t seed) {
  std::vector<AuditPixel> out;
  for (int y = std::max(seen.y0, tile.rect.y0); y < std::min(seen.y1, tile.rect.y1); ++y)
    for (int x = std::max(seen.x0, tile.rect.x0); x < std::min(seen.x1, tile.rect.x1); ++x)
      if (tile.pixel(x, y).count > 0) {
        const uint32_t place = hashCombine(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
        out.push_back({hashCombine(place, seed, randomStream("audi")), x, y, {}});
      }
  keepFirst(out, count);
  for (AuditPixel& p : out) {
    const ivec2 at(p.x, p.y);
    p.tile = copyPixels(tile, {p.x, p.y, p.x + 1, p.y + 1}, {&at, 1});
  }
  return out;
}

/// Colour and opacity where the samples of a fragment see its facet.
struct Seen {
  vec3 color{0.0f}, opacity{0.0f};
  Seen(const DeepTile& tile, const Fragment& fragment) {
    const Facet& facet = tile.facets[fragment.facet];
    const ShadedPoints& shaded = tile.shaded[static_cast<size_t>(facet.batch)];
    const std::array<float, 4> weight = fragment.cornerWeights();
    for (size_t corner = 0; corner < 4; ++corner) {
      if (!facet.matte) color += weight[corner] * shaded.color(facet.point[corner]);
      opacity += weight[corner] * shaded.opacity(facet.point[corner]);
    }
  }
};

}  // namespace

DeepTile copyPixels(const DeepTile& from, const PixelRect& rect, std::span<const ivec2> pixels) {
  PixelCopy copy(from, rect);
  for (const ivec2& at : pixels) copy.add(at);
  return copy.take();
}

double pointsOf(const DeepTile& tile) {
  double out = 0;
  for (const ShadePoints& batch : tile.batches) out += batch.count();
  return out;
}

SampledColor colorOf(const DeepTile& tile, const ivec2& at, int samplesPerPixel) {
  const auto count = static_cast<size_t>(samplesPerPixel);
  std::vector<vec3> clear(count, vec3(1.0f)), colors(count, vec3(0.0f));
  const DeepPixel& pixel = tile.pixel(at.x, at.y);
  for (uint32_t f = pixel.first; f < pixel.first + pixel.count; ++f) {
    const Fragment& fragment = tile.fragments[f];
    const Seen seen(tile, fragment);
    for (size_t bit = 0; bit < 64; ++bit) {
      const size_t s = size_t{64} * fragment.word + bit;
      if (!(fragment.samples >> bit & 1) || s >= count) continue;
      colors[s] += clear[s] * seen.color;
      clear[s] *= vec3(1.0f) - seen.opacity;
    }
  }
  SampledColor out;
  const auto n = static_cast<float>(samplesPerPixel);
  for (const vec3& c : colors) out.mean += c / n;
  if (count < 2) return out;
  vec3 squares(0.0f);
  for (const vec3& c : colors) squares += (c - out.mean) * (c - out.mean);
  out.error = glm::sqrt(squares / (n * (n - 1)));
  return out;
}

std::vector<AuditPixel> chooseAuditPixels(const DeepFrame& layout, const TileReader& tiles, size_t count, uint32_t seed,
                                          StopToken stop) {
  std::vector<AuditPixel> out;
  std::mutex merging;
  parallelFor(layout.tileCount(), 1, [&](size_t t, size_t) {
    const bool seen = layout.rectOf(t).overlaps(layout.crop);
    const auto tile = seen && !stop.requested() ? tiles(t) : nullptr;
    if (!tile) return;
    std::vector<AuditPixel> here = pixelsOfTile(*tile, layout.crop, count, seed);
    const std::lock_guard lock(merging);
    std::move(here.begin(), here.end(), std::back_inserter(out));
    keepFirst(out, count);
  });
  std::sort(out.begin(), out.end(),
            [](const AuditPixel& a, const AuditPixel& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  return out;
}

std::vector<SampledColor> shadeAuditPixels(const std::vector<AuditPixel>& pixels, int samplesPerPixel,
                                           const Scene& scene, const ShadingSystem& shading,
                                           const ShadeContext& context) {
  std::vector<SampledColor> out(pixels.size());
  parallelFor(pixels.size(), 1, [&](size_t p, size_t) {
    DeepTile tile = pixels[p].tile;
    shadeTile(tile, scene, shading, context);
    out[p] = colorOf(tile, {pixels[p].x, pixels[p].y}, samplesPerPixel);
  });
  return out;
}

}  // namespace tomales

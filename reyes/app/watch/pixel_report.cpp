#include "reyes/app/watch/pixel_report.h"

#include <fmt/format.h>

#include <bit>

namespace tomales {
namespace {

std::string text(const vec3& v) { return fmt::format("{:.5g} {:.5g} {:.5g}", v.x, v.y, v.z); }

/// Returns the mean of f over the points of a facet.
template <class F>
vec3 mean(const Facet& facet, const F& f) {
  return 0.25f * (f(facet.point[0]) + f(facet.point[1]) + f(facet.point[2]) + f(facet.point[3]));
}

}  // namespace

std::string pixelReport(const DeepTile& tile, int x, int y, int samplesPerPixel, const Scene& scene) {
  const DeepPixel& pixel = tile.pixel(x, y);
  std::string out = fmt::format("pixel {},{}: {} samples see {} micropolygons\n", x, y, samplesPerPixel, pixel.count);
  const size_t words = static_cast<size_t>(samplesPerPixel + 63) / 64;
  std::vector<vec3> clear(64 * words, vec3(1.0f));
  vec3 color(0), alpha(0);
  for (uint32_t i = pixel.first; i < pixel.first + pixel.count; ++i) {
    const Fragment& f = tile.fragments[i];
    const Facet& facet = tile.facets[f.facet];
    const auto b = static_cast<size_t>(facet.batch);
    const ShadePoints& points = tile.batches[b];
    const ShadedPoints& shaded = tile.shaded[b];
    const ShadeGroup& group = scene.groups[static_cast<size_t>(points.group())];
    const vec3 Ci = mean(facet, [&](int p) { return shaded.color(p); }),
               Oi = mean(facet, [&](int p) { return shaded.opacity(p); });
    out += fmt::format(
        "  z {:.6g}  {} samples  {} ({})  {}{}\n    Ci {}  Oi {}  P {}  N {}\n", f.z, std::popcount(f.samples),
        group.attributes->name.empty() ? "object" : "\"" + group.attributes->name + "\"", group.where.text(),
        group.attributes->surface ? group.attributes->surface->name : "defaultsurface", facet.matte ? ", matte" : "",
        text(Ci), text(Oi), text(mean(facet, [&](int p) { return points.position(p); })),
        text(mean(facet, [&](int p) { return points.get3(kNx, p); })));
    for (uint64_t left = f.samples; left; left &= left - 1) {
      vec3& through = clear[size_t{f.word} * 64 + static_cast<size_t>(std::countr_zero(left))];
      if (!facet.matte) {
        color += through * Ci;
        alpha += through * Oi;
      }
      through *= vec3(1.0f) - Oi;
    }
  }
  const float share = 1 / static_cast<float>(samplesPerPixel);
  return out + fmt::format("  mean of its samples: {}  opacity {}\n", text(share * color), text(share * alpha));
}

}  // namespace tomales

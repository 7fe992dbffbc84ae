#include "gi/radiosity_maps.h"

#include <fmt/format.h>

#include "gi/radiosity_bake.h"
#include "reyes/base/parallel.h"

namespace tomales {
namespace {

constexpr int64_t kTexelsPerRun = 256;  ///< That one thread bakes at a time, at least.

/// Why an object has no map; null: it has one.
const char* refusal(const ShadingSystem& shading, const Object& o) {
  const Attributes& a = *o.attributes;
  if (o.solid >= 0) return "it is part of a solid";
  if (o.shape().facing(vec3(0), vec3(0, 0, 1), true)) return "it turns to the eye";
  if (a.displacement && a.trace.displacements) return "rays see its displacement";
  if (!shading.opaque(o.group)) return "it is not opaque";
  return nullptr;
}

}  // namespace

int RadiosityChart::levels() const {
  int n = 1;
  for (int size = std::max(width, height); size > 1; size /= 2) ++n;
  return n;
}

void RadiosityChart::makeLevels() {
  size_t from = 0;
  int w = width, h = height;
  while (w > 1 || h > 1) {
    const int sx = w > 1 ? 2 : 1, sy = h > 1 ? 2 : 1;
    for (int y = 0; y < h; y += sy)
      for (int x = 0; x < w; x += sx) {
        vec3 sum(0);
        for (int j = 0; j < sy; ++j)
          for (int i = 0; i < sx; ++i) sum += texels[from + static_cast<size_t>((y + j) * w + x + i)];
        texels.push_back(sum / static_cast<float>(sx * sy));
      }
    from += static_cast<size_t>(w) * static_cast<size_t>(h);
    w /= sx, h /= sy;
  }
}

vec3 RadiosityChart::atLevel(int level, float u, float v) const {
  size_t from = 0;
  int w = width, h = height;
  for (; level > 0; --level) from += static_cast<size_t>(w) * static_cast<size_t>(h), w = std::max(1, w / 2), h = std::max(1, h / 2);
  const float x = std::clamp(u * static_cast<float>(w) - 0.5f, 0.0f, static_cast<float>(w - 1));
  const float y = std::clamp(v * static_cast<float>(h) - 0.5f, 0.0f, static_cast<float>(h - 1));
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y), x1 = std::min(x0 + 1, w - 1), y1 = std::min(y0 + 1, h - 1);
  const auto at = [&](int i, int j) { return texels[from + static_cast<size_t>(j * w + i)]; };
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  return glm::mix(glm::mix(at(x0, y0), at(x1, y0), fx), glm::mix(at(x0, y1), at(x1, y1), fx), fy);
}

vec3 RadiosityChart::lookup(float u, float v, float footprint) const {
  const float level = std::clamp(std::log2(std::max(footprint, 1e-20f) / texelSize), 0.0f, static_cast<float>(levels() - 1));
  const int finer = static_cast<int>(level);
  const float part = level - static_cast<float>(finer);
  const vec3 below = atLevel(finer, u, v);
  return part > 0 ? glm::mix(below, atLevel(finer + 1, u, v), part) : below;
}

RadiosityMaps::RadiosityMaps(const RayScene& rays, const ShadingSystem& shading, const Camera& camera, const RadiositySettings& settings, Log& log)
    : scene_(rays.scene()), maps_(scene_.objects.size()) {
  std::vector<int> mapped;
  for (size_t i = 0; i < scene_.objects.size(); ++i) {
    const Object& o = scene_.objects[i];
    const Attributes& a = *o.attributes;
    if (!a.visibility.diffuse || a.radiosity.texelSize <= 0) continue;
    const char* why = refusal(shading, o);
    if (!why)
      mapped.push_back(static_cast<int>(i));
    else
      log.report(Severity::Info, fmt::format("radiosity-map-{}", why), o.where,
                 fmt::format("\"{}\" has no radiosity map, because {}; it is shaded where gather rays hit it", a.name, why));
  }
  parallelFor(mapped.size(), 1, [&](size_t k, size_t) {
    Map& map = maps_[static_cast<size_t>(mapped[k])];
    map.front = layOutCharts(scene_, camera, mapped[k], settings.texels);
    if (scene_.objects[static_cast<size_t>(mapped[k])].attributes->sides == 2) map.back = map.front;
  });
  std::vector<Run> runs;
  for (const int object : mapped)
    for (const bool back : {false, true}) addRuns(object, back, runs);
  const RadiosityBake bake{rays, shading, settings};
  parallelFor(runs.size(), 1, [&](size_t r, size_t) {
    const Run& run = runs[r];
    Map& map = maps_[static_cast<size_t>(run.object)];
    bakeCharts(bake, run.object, run.first, run.back, std::span(run.back ? map.back : map.front).subspan(run.first, run.count));
  });
}

void RadiosityMaps::addRuns(int object, bool back, std::vector<Run>& runs) const {
  const Map& map = maps_[static_cast<size_t>(object)];
  const std::vector<RadiosityChart>& charts = back ? map.back : map.front;
  int64_t texels = kTexelsPerRun;
  for (uint32_t p = 0; p < charts.size(); ++p) {
    if (texels >= kTexelsPerRun) runs.push_back({object, p, 0, back}), texels = 0;
    texels += static_cast<int64_t>(charts[p].width) * charts[p].height, ++runs.back().count;
  }
}

bool RadiosityMaps::lookup(const Ray& ray, const Hit& hit, vec3& radiance) const {
  const Map& map = maps_[static_cast<size_t>(hit.object)];
  const bool back = dot(ray.direction, hit.geometricNormal) > 0;
  const std::vector<RadiosityChart>& charts = back && !map.back.empty() ? map.back : map.front;
  if (charts.empty()) return false;
  radiance = charts[hit.patch].lookup(hit.u, hit.v, 2 * (ray.radius + ray.spread * hit.t));
  return true;
}

int64_t RadiosityMaps::texelCount() const {
  int64_t sum = 0;
  for (const Map& m : maps_)
    for (const auto* side : {&m.front, &m.back})
      for (const RadiosityChart& c : *side) sum += static_cast<int64_t>(c.width) * c.height;
  return sum;
}

}  // namespace tomales

#include "gi/radiosity_maps.h"

#include <fmt/format.h>

#include "gi/radiosity_bake.h"
#include "reyes/base/parallel.h"

namespace tomales {
namespace {

constexpr size_t kTexelsPerRun = 1024;  ///< That one thread bakes at a time.
constexpr size_t kChartsPerTask = 16;

/// Why an object has no map; null: it has one.
const char* refusal(const ShadingSystem& shading, const Object& o) {
  const Attributes& a = *o.attributes;
  if (o.solid >= 0) return "it is part of a solid";
  if (o.shape().facing(vec3(0), vec3(0, 0, 1), true)) return "it turns to the eye";
  if (a.displacement && a.trace.displacements) return "rays see its displacement";
  if (!shading.opaque(o.group)) return "it is not opaque";
  if (shading.tracesRays(o.group)) return "its shader traces rays";
  return nullptr;
}

}  // namespace

int RadiosityChart::levels() const {
  int n = 1;
  for (int size = std::max(width, height); size > 1; size /= 2) ++n;
  return n;
}

void RadiosityChart::halve() {
  const int before = width * height;
  width = std::max(1, width / 2), height = std::max(1, height / 2);
  texelSize *= std::sqrt(static_cast<float>(before) / static_cast<float>(width * height));
}

void RadiosityChart::allocate() {
  texels.assign(static_cast<size_t>(width) * static_cast<size_t>(height), vec3(0));
  coverage.assign(texels.size(), 0.0f);
}

// Push and pull (Gortler et al. 1996), so that what is trimmed away darkens nothing along its edge.
void RadiosityChart::makeLevels() {
  struct Step {
    size_t from;  ///< The finer level; the coarser one follows.
    int width, height, sx, sy;
    size_t at(int x, int y) const { return from + static_cast<size_t>(y * width + x); }
    size_t coarser(int x, int y) const { return at(0, height) + static_cast<size_t>(y / sy * (width / sx) + x / sx); }
  };
  if (coverage.empty()) coverage.assign(texels.size(), 1.0f);
  std::vector<Step> steps;
  for (Step s{0, width, height, 1, 1}; s.width > 1 || s.height > 1; s = {s.at(0, s.height), s.width / s.sx, s.height / s.sy, 1, 1}) {
    s.sx = s.width > 1 ? 2 : 1, s.sy = s.height > 1 ? 2 : 1;
    for (int y = 0; y < s.height; y += s.sy)
      for (int x = 0; x < s.width; x += s.sx) {
        vec3 sum(0);
        float known = 0;
        for (int j = 0; j < s.sy; ++j)
          for (int i = 0; i < s.sx; ++i) sum += coverage[s.at(x + i, y + j)] * texels[s.at(x + i, y + j)], known += coverage[s.at(x + i, y + j)];
        texels.push_back(known > 0 ? sum / known : vec3(0));
        coverage.push_back(known / static_cast<float>(s.sx * s.sy));
      }
    steps.push_back(s);
  }
  for (auto s = steps.rbegin(); s != steps.rend(); ++s)
    for (int y = 0; y < s->height; ++y)
      for (int x = 0; x < s->width; ++x)
        if (!(coverage[s->at(x, y)] > 0)) texels[s->at(x, y)] = texels[s->coarser(x, y)];
  coverage = {};
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
  layOut(mapped, camera, settings, log);
  std::vector<Run> runs;
  std::vector<RadiosityChart*> charts;
  for (const int object : mapped)
    for (const bool back : {false, true}) {
      addRuns(object, back, runs);
      for (RadiosityChart& c : side(object, back)) charts.push_back(&c);
    }
  const RadiosityBake bake{rays, shading, settings};
  parallelFor(runs.size(), 1, [&](size_t r, size_t) { bakeTexels(bake, runs[r].object, runs[r].back, side(runs[r].object, runs[r].back), runs[r].texels); });
  parallelFor(charts.size(), kChartsPerTask, [&](size_t begin, size_t end) {
    for (size_t c = begin; c < end; ++c) charts[c]->makeLevels();
  });
}

void RadiosityMaps::layOut(const std::vector<int>& mapped, const Camera& camera, const RadiositySettings& settings, Log& log) {
  struct Patch {
    int object;
    uint32_t number;
  };
  std::vector<Patch> patches;
  for (const int object : mapped) {
    const uint32_t count = scene_.objects[static_cast<size_t>(object)].shape().patchCount();
    side(object, false).resize(count);
    for (uint32_t p = 0; p < count; ++p) patches.push_back({object, p});
  }
  parallelFor(patches.size(), kChartsPerTask, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) side(patches[i].object, false)[patches[i].number] = chartOf(scene_, camera, patches[i].object, patches[i].number, settings.texels);
  });
  const auto hasBack = [&](int object) { return scene_.objects[static_cast<size_t>(object)].attributes->sides == 2; };
  for (const int object : mapped)
    if (hasBack(object)) side(object, true) = side(object, false);
  int halvings = 0;
  const auto charts = static_cast<int64_t>(patches.size());
  for (int64_t before = 0, now = texelCount(); now > std::max(settings.mostTexels, charts) && now != before; before = now, now = texelCount(), ++halvings)
    forEachChart([](RadiosityChart& c) { c.halve(); });
  if (halvings > 0)
    log.report(Severity::Warning, "radiosity-texels", {},
               fmt::format("all radiosity maps together would have more than {} million texels: their edges have 1/{} of what was asked", settings.mostTexels >> 20, 1 << halvings));
  forEachChart([](RadiosityChart& c) { c.allocate(); });
}

void RadiosityMaps::addRuns(int object, bool back, std::vector<Run>& runs) const {
  const std::vector<RadiosityChart>& all = charts(object, back);
  size_t room = 0;
  for (size_t p = 0; p < all.size(); ++p)
    for (size_t t = 0; t < all[p].texels.size();) {
      if (room == 0) runs.push_back({object, back, {p, t, 0}}), room = kTexelsPerRun;
      const size_t taken = std::min(room, all[p].texels.size() - t);
      runs.back().texels.count += taken, room -= taken, t += taken;
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

#include "gi/radiosity/maps.h"

#include <atomic>

#include "gi/radiosity/bake.h"
#include "reyes/base/parallel.h"
#include "reyes/base/stop.h"

namespace tomales {

template <class A>
void fields(A& a, BakedTexel& x) {
  auto& [radiance, coverage] = x;
  each(a, radiance, coverage);
}

namespace {

/// Bakes a run of texels, or takes over what an interrupted run has baked.
std::vector<BakedTexel> keptTexels(const RadiosityBake& bake, std::span<const RadiosityChart> charts,
                                   const TexelRun& run, size_t index) {
  Checkpoint* kept = bake.settings.kept;
  std::vector<BakedTexel> out;
  if (kept && kept->take(KeptKind::RadiosityTexels, index, out) && out.size() == run.count) return out;
  out = bakeTexels(bake, charts, run);
  if (kept) kept->keep(KeptKind::RadiosityTexels, index, out);
  return out;
}

}  // namespace

int RadiosityChart::levels() const {
  int n = 1;
  for (int size = std::max(width, height); size > 1; size /= 2) ++n;
  return n;
}

void RadiosityChart::halve() {
  const int before = width * height;
  width = std::max(1, width / 2);
  height = std::max(1, height / 2);
  texelSize *= std::sqrt(static_cast<float>(before) / static_cast<float>(width * height));
}

void RadiosityChart::allocate() {
  texels.assign(texelCount(), vec3(0));
  coverage.assign(texels.size(), 0.0f);
}

// The method is "push-pull" (Gortler et al. 1996, "The Lumigraph"). With it, trimmed parts do not darken the texels
// along their edge.
void RadiosityChart::makeLevels() {
  struct Step {
    size_t from;  ///< Offset of the finer level; the coarser one follows it.
    int width, height, sx, sy;
    size_t at(int x, int y) const { return from + static_cast<size_t>(y * width + x); }
    size_t coarser(int x, int y) const { return at(0, height) + static_cast<size_t>(y / sy * (width / sx) + x / sx); }
  };
  if (coverage.empty()) coverage.assign(texels.size(), 1.0f);
  std::vector<Step> steps;
  for (Step s{0, width, height, 1, 1}; s.width > 1 || s.height > 1;
       s = {s.at(0, s.height), s.width / s.sx, s.height / s.sy, 1, 1}) {
    s.sx = s.width > 1 ? 2 : 1;
    s.sy = s.height > 1 ? 2 : 1;
    for (int y = 0; y < s.height; y += s.sy)
      for (int x = 0; x < s.width; x += s.sx) {
        vec3 sum(0);
        float known = 0;
        for (int j = 0; j < s.sy; ++j)
          for (int i = 0; i < s.sx; ++i) {
            sum += coverage[s.at(x + i, y + j)] * texels[s.at(x + i, y + j)];
            known += coverage[s.at(x + i, y + j)];
          }
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
  for (; level > 0; --level) {
    from += static_cast<size_t>(w) * static_cast<size_t>(h);
    w = std::max(1, w / 2);
    h = std::max(1, h / 2);
  }
  const float x = std::clamp(u * static_cast<float>(w) - 0.5f, 0.0f, static_cast<float>(w - 1));
  const float y = std::clamp(v * static_cast<float>(h) - 0.5f, 0.0f, static_cast<float>(h - 1));
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y), x1 = std::min(x0 + 1, w - 1),
            y1 = std::min(y0 + 1, h - 1);
  const auto at = [&](int i, int j) { return texels[from + static_cast<size_t>(j * w + i)]; };
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  return glm::mix(glm::mix(at(x0, y0), at(x1, y0), fx), glm::mix(at(x0, y1), at(x1, y1), fx), fy);
}

vec3 RadiosityChart::lookup(float u, float v, float footprint) const {
  const float level =
      std::clamp(std::log2(std::max(footprint, 1e-20f) / texelSize), 0.0f, static_cast<float>(levels() - 1));
  const int finer = static_cast<int>(level);
  const float part = level - static_cast<float>(finer);
  const vec3 below = atLevel(finer, u, v);
  return part > 0 ? glm::mix(below, atLevel(finer + 1, u, v), part) : below;
}

RadiosityMaps::RadiosityMaps(const RayScene& rays, const ShadingSystem& shading, const Camera& camera,
                             const RadiositySettings& settings, Log& log)
    : surfaces_(layOutCharts(rays.scene(), bakedObjects(rays.scene(), shading, log), camera, settings, log)) {
  std::vector<RadiosityChart*> charts;
  for (SurfaceCharts& s : surfaces_)
    for (const bool back : {false, true})
      for (RadiosityChart& c : s.side(back)) {
        c.allocate();
        charts.push_back(&c);
      }
  const std::vector<TexelRun> runs = texelRuns(surfaces_);
  const RadiosityBake bake{rays, shading, settings};
  std::atomic<size_t> done{0};
  parallelFor(runs.size(), 1, [&](size_t r, size_t) {
    throwIfStopped();
    std::vector<RadiosityChart>& of = surfaces_[static_cast<size_t>(runs[r].object)].side(runs[r].back);
    const std::vector<BakedTexel> baked = keptTexels(bake, of, runs[r], r);
    size_t k = 0;
    forEachTexel(of, runs[r], [&](uint32_t patch, size_t t) {
      of[patch].texels[t] = baked[k].radiance;
      of[patch].coverage[t] = baked[k].coverage;
      ++k;
    });
    if (settings.progress) settings.progress(static_cast<float>(++done) / static_cast<float>(runs.size()));
  });
  parallelFor(charts.size(), kChartsPerTask, [&](size_t begin, size_t end) {
    for (size_t c = begin; c < end; ++c) charts[c]->makeLevels();
  });
}

RadiosityMaps::~RadiosityMaps() = default;

const std::vector<RadiosityChart>& RadiosityMaps::charts(int object, bool back) const {
  return surfaces_[static_cast<size_t>(object)].side(back);
}

bool RadiosityMaps::lookup(const Ray& ray, const Hit& hit, vec3& radiance) const {
  const SurfaceCharts& map = surfaces_[static_cast<size_t>(hit.object)];
  const bool back = dot(ray.direction, hit.geometricNormal) > 0;
  const std::vector<RadiosityChart>& charts = map.side(back);
  if (charts.empty()) return false;
  radiance = charts[hit.patch].lookup(hit.u, hit.v, 2 * (ray.radius + ray.spread * hit.t));
  return true;
}

int64_t RadiosityMaps::texelCount() const {
  int64_t sum = 0;
  for (const SurfaceCharts& s : surfaces_)
    for (const bool back : {false, true})
      for (const RadiosityChart& c : s.side(back)) sum += static_cast<int64_t>(c.texelCount());
  return sum;
}

}  // namespace tomales

#include "gi/radiosity/layout.h"

#include <fmt/format.h>

#include "reyes/base/parallel.h"
#include "reyes/dice.h"

namespace tomales {
namespace {

constexpr int kLayoutProbes = 4;  ///< Number of steps along each side of a patch by which its size is measured.
/// Number of patches of an object above which each patch counts as small, and is measured by its corners alone.
constexpr uint32_t kManyPatches = 4096;
constexpr int kMostTexels = 2048;                                        ///< Limit along an edge of a chart.
constexpr int64_t kAlwaysTexels = int64_t{1} << 18, kMostOfPixel = 256;  ///< Limits for all charts, and for a pixel.
constexpr size_t kTexelsPerRun = 1024;                                   ///< Texels that one thread bakes at a time.

int powerOfTwoNear(float texels) {
  const float clamped = std::clamp(texels, 1.0f, static_cast<float>(kMostTexels));
  return 1 << static_cast<int>(std::lround(std::log2(clamped)));
}

/// Returns why an object has no map; null: it has one.
const char* refusal(const ShadingSystem& shading, const Object& o) {
  const Attributes& a = *o.attributes;
  if (o.solid >= 0) return "it is part of a solid";
  if (o.shape().facing(vec3(0), vec3(0, 0, 1), true)) return "it turns to the eye";
  if (a.displacement && a.trace.displacements) return "rays see its displacement";
  if (!shading.group(o.group).opaque()) return "it is not opaque";
  if (shading.group(o.group).tracesRays()) return "its shader traces rays";
  return nullptr;
}

RadiosityChart chartOf(const Scene& scene, const Camera& camera, int object, uint32_t patch, float texels) {
  const int probes = scene.objects[static_cast<size_t>(object)].shape().patchCount() > kManyPatches ? 1 : kLayoutProbes;
  vec3 at[kLayoutProbes + 1][kLayoutProbes + 1];
  vec3 middle(0);
  for (int j = 0; j <= probes; ++j)
    for (int i = 0; i <= probes; ++i) {
      at[j][i] = surfaceAt(scene, object, patch, static_cast<float>(i) / static_cast<float>(probes),
                           static_cast<float>(j) / static_cast<float>(probes))
                     .P;
      middle += at[j][i] / static_cast<float>((probes + 1) * (probes + 1));
    }
  float alongU = 0, alongV = 0;
  for (int j = 0; j <= probes; ++j) {
    float u = 0, v = 0;
    for (int i = 0; i < probes; ++i) {
      u += glm::length(at[j][i + 1] - at[j][i]);
      v += glm::length(at[i + 1][j] - at[i][j]);
    }
    alongU = std::max(alongU, u);
    alongV = std::max(alongV, v);
  }
  const Attributes::Radiosity& asked = scene.objects[static_cast<size_t>(object)].attributes->radiosity;
  // The size depends on the distance alone, so that hidden surfaces are no coarser than visible ones as far away.
  const float unit =
      asked.screen ? camera.pixelSize({0, 0, glm::length(middle)}) : lengthScale(scene.cameraFromWorldAtOpen());
  const float texel = std::max(asked.texelSize * unit / texels, 1e-12f);
  RadiosityChart chart;
  chart.width = powerOfTwoNear(alongU / texel);
  chart.height = powerOfTwoNear(alongV / texel);
  chart.texelSize =
      std::max(std::sqrt(alongU / static_cast<float>(chart.width) * alongV / static_cast<float>(chart.height)), 1e-20f);
  return chart;
}

/// Returns the limit for all maps together. A small picture gets fewer, since it shows little of them.
int64_t mostTexels(const Camera& camera, const RadiositySettings& settings) {
  const int64_t ofPicture = kMostOfPixel * camera.xResolution() * camera.yResolution();
  return std::min(settings.mostTexels, std::max(kAlwaysTexels, ofPicture));
}

void halveUntilFew(std::vector<SurfaceCharts>& surfaces, int64_t limit, Log& log) {
  const auto forEachChart = [&](const auto& visit) {
    for (SurfaceCharts& s : surfaces)
      for (const bool back : {false, true})
        for (RadiosityChart& c : s.side(back)) visit(c);
  };
  const auto count = [&] {
    int64_t sum = 0;
    forEachChart([&](const RadiosityChart& c) { sum += static_cast<int64_t>(c.texelCount()); });
    return sum;
  };
  int64_t most = 0;  // every chart keeps at least one texel
  forEachChart([&](const RadiosityChart&) { ++most; });
  most = std::max(most, limit);
  int halvings = 0;
  for (; count() > most; ++halvings) forEachChart([](RadiosityChart& c) { c.halve(); });
  if (halvings > 0)
    log.report(
        Severity::Warning, "radiosity-texels", {},
        fmt::format("all radiosity maps together would have more than {:.2g} million texels: their edges have 1/{} "
                    "of what was asked",
                    static_cast<double>(limit) / 1e6, 1 << halvings));
}

}  // namespace

std::vector<int> bakedObjects(const Scene& scene, const ShadingSystem& shading, Log& log) {
  std::vector<int> mapped;
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& o = scene.objects[i];
    const Attributes& a = *o.attributes;
    if (!a.visibility.diffuse || a.radiosity.texelSize <= 0) continue;
    const char* why = refusal(shading, o);
    if (!why)
      mapped.push_back(static_cast<int>(i));
    else
      log.report(
          Severity::Info, "radiosity-map", o.where,
          fmt::format("\"{}\" has no radiosity map, because {}; it is shaded where gather rays hit it", a.name, why));
  }
  return mapped;
}

std::vector<SurfaceCharts> layOutCharts(const Scene& scene, const std::vector<int>& mapped, const Camera& camera,
                                        const RadiositySettings& settings, Log& log) {
  std::vector<SurfaceCharts> surfaces(scene.objects.size());
  struct Patch {
    int object;
    uint32_t number;
  };
  std::vector<Patch> patches;
  for (const int object : mapped) {
    const uint32_t count = scene.objects[static_cast<size_t>(object)].shape().patchCount();
    surfaces[static_cast<size_t>(object)].front.resize(count);
    for (uint32_t p = 0; p < count; ++p) patches.push_back({object, p});
  }
  parallelFor(patches.size(), kChartsPerTask, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      surfaces[static_cast<size_t>(patches[i].object)].front[patches[i].number] =
          chartOf(scene, camera, patches[i].object, patches[i].number, settings.texels);
  });
  for (const int object : mapped)
    if (SurfaceCharts& s = surfaces[static_cast<size_t>(object)];
        scene.objects[static_cast<size_t>(object)].attributes->sides == 2)
      s.back = s.front;
  halveUntilFew(surfaces, mostTexels(camera, settings), log);
  return surfaces;
}

std::vector<TexelRun> texelRuns(std::span<const SurfaceCharts> surfaces) {
  std::vector<TexelRun> runs;
  for (size_t object = 0; object < surfaces.size(); ++object)
    for (const bool back : {false, true}) {
      const std::vector<RadiosityChart>& charts = surfaces[object].side(back);
      size_t room = 0;
      for (size_t p = 0; p < charts.size(); ++p)
        for (size_t t = 0; t < charts[p].texelCount();) {
          if (room == 0) {
            runs.push_back({static_cast<int>(object), back, p, t, 0});
            room = kTexelsPerRun;
          }
          const size_t taken = std::min(room, charts[p].texelCount() - t);
          runs.back().count += taken;
          room -= taken;
          t += taken;
        }
    }
  return runs;
}

}  // namespace tomales

#include "reyes/app/frame/limits.h"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <string>

#include "reyes/camera.h"

namespace tomales {
namespace {

constexpr float kShift_px = 0.25f;
constexpr float kCoarse_px2 = 16;
constexpr float kUncertain = 0.1f, kDark = 0.1f;
constexpr float kShareOfRecords = 0.5f;
constexpr double kUncertainLight = 0.25;
constexpr double kShareOfStarts = 0.42;
constexpr int64_t kFewStarts = 10'000;  // Fewer starts of rays say nothing about the whole.
constexpr size_t kFewRecords = 32;      // Fewer records say nothing about the whole.

}  // namespace

void warnOfFloatRange(const Scene& scene, Log& log) {
  // Object to camera is one matrix, whose translation is the sum of two nearly opposite ones of about this length. The
  // error along the depth moves nothing in the picture.
  const float away = glm::length(vec2(scene.cameraFromWorldAtOpen()[3]));
  const float lost = away * std::numeric_limits<float>::epsilon();
  const Camera camera(scene.options);
  for (const Object& o : scene.objects) {
    if (o.shapes.empty() || !o.attributes->visibility.camera) continue;
    const Bound3 bound = transformBound(o.cameraFromObject.keys.front(), o.shapes.front()->bound(0, {}));
    const float pixel = camera.pixelSize(bound.center());
    if (!(bound.lo.z > 0 && lost > kShift_px * pixel)) continue;
    log.report(Severity::Warning, "float-range", o.where,
               fmt::format("{}: the camera is {:.3g} units away from the origin of the world, where floats are {:.2g} "
                           "apart; a pixel is {:.2g} there: "
                           "move camera and scene nearer to the origin",
                           objectName(o), away, lost, pixel));
    return;
  }
}

void warnOfCoarseDicing(const Scene& scene, Log& log) {
  for (const Object& o : scene.objects) {
    const Attributes& a = *o.attributes;
    if (a.shadingRate < kCoarse_px2 || o.shapes.empty() || !a.visibility.camera) continue;
    if (!a.displacement && (o.shapes.front()->patchCount() == 0 || o.shapes.front()->info(0).planar)) continue;
    log.report(Severity::Warning, "dice-coarse", o.where,
               fmt::format("{}: micropolygons of {:.3g} square pixels leave corners in outlines and miss what is finer "
                           "(ShadingRate, --shading-rate)",
                           objectName(o), a.shadingRate));
    return;
  }
}

void warnOfNoise(std::span<const PreparedCache> caches, Log& log) {
  for (const PreparedCache& c : caches) {
    if (c.key.gather.isOcclusion()) continue;  // it asks for its rays itself, and knows its allowed error
    const char* const knob =
        c.key.gather.asked ? "samples of indirectdiffuse()" : "\"samples\" of indirectlight, --samples";
    const IrradianceRecords& records = c.cache.records();
    if (records.size() < kFewRecords) continue;
    double sum = 0, noise = 0;
    for (const IrradianceRecord& r : records) {
      sum += luminance(r.light.E);
      noise += r.noise;
    }
    const float dark = kDark * static_cast<float>(sum / static_cast<double>(records.size()));
    const auto uncertain = std::count_if(records.begin(), records.end(), [&](const IrradianceRecord& r) {
      return r.noise > kUncertain * std::max(luminance(r.light.E), dark);
    });
    const float share = static_cast<float>(uncertain) / static_cast<float>(records.size());
    if (share > kShareOfRecords)
      log.report(Severity::Warning, "gather-noise", {},
                 fmt::format("{:.0f} % of {} irradiance records are uncertain by more than {:.0f} %: {} rays per "
                             "record are too few for this light ({})",
                             100 * share, records.size(), 100 * kUncertain, c.key.gather.samples, knob));
    else if (sum > 0 && noise > kUncertainLight * sum)
      log.report(Severity::Warning, "gather-few", {},
                 fmt::format("indirect light is uncertain by {:.0f} %: most of it comes by a few of the {} rays of a "
                             "record, from something small and bright, which others miss ({})",
                             100 * noise / sum, c.key.gather.samples, knob));
  }
}

void warnOfThinWalls(const RayScene& rays, Log& log) {
  struct Thin {
    const ShadeGroup* worst;
    double share;
    int others;
  };
  const Scene& scene = rays.scene();
  std::map<std::string, Thin> thin;  // by name, because a house has many attribute states
  for (const auto& [group, starts] : rays.starts()) {
    if (starts.rays < kFewStarts) continue;
    const double share = static_cast<double>(starts.crowded) / static_cast<double>(starts.rays);
    if (share <= kShareOfStarts) continue;
    const ShadeGroup& g = scene.groups[static_cast<size_t>(group)];
    const auto [at, first] = thin.try_emplace(objectName(g), Thin{&g, share, 0});
    if (first) continue;
    ++at->second.others;
    if (share > at->second.share) {
      at->second.worst = &g;
      at->second.share = share;
    }
  }
  for (const auto& [name, t] : thin)
    log.report(
        Severity::Warning, "offset-thin", t.worst->where,
        fmt::format("{}: {:.0f} % of the rays that leave it start between two surfaces that are closer together "
                    "than the error of the polygons that rays meet; light may leak through{} (Attribute \"trace\" "
                    "\"tessellationmode\" \"fixed\" and \"tessellation\" above 1, or \"offset\")",
                    name, 100 * t.share, t.others ? fmt::format("; so do {} more of that name", t.others) : ""));
}

}  // namespace tomales

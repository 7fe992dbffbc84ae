#include "gi/atlas_limits.h"

#include <fmt/format.h>

namespace tomales {
namespace {

constexpr int64_t kFewEstimates = 32;   // say nothing about the whole
constexpr double kMost = 0.5;           // of them on weak ground
constexpr double kClumped = 1.2;

/// The first object whose light a map has; null: none.
const Object* objectOf(const Scene& scene, const MapNames& names, const std::string& map) {
  for (size_t g = 0; g < scene.groups.size(); ++g)
    if (const int example = scene.groups[g].exampleObject; example >= 0 && (names.global[g] == map || names.caustic[g] == map))
      return &scene.objects[static_cast<size_t>(example)];
  return nullptr;
}

}  // namespace

void warnOfEstimates(const Scene& scene, const MapNames& names, const std::string& map, const EstimateFigures& figures, Log& log) {
  const Object* o = objectOf(scene, names, map);
  if (!o || figures.made < kFewEstimates) return;
  const auto report = [&](const char* code, int64_t weak, const char* why) {
    const double share = static_cast<double>(weak) / static_cast<double>(figures.made);
    if (share > kMost)
      log.report(Severity::Warning, code, o->where,
                 fmt::format("{}: {:.0f} % of the irradiance estimates of photon map \"{}\" {} (more photons, --photons)", objectName(*o), 100 * share, map, why));
  };
  report("photon-few", figures.few, "have fewer photons in reach than they ask for: light is smeared and noisy");
  if (figures.clumps > kClumped * static_cast<double>(figures.made))
    log.report(Severity::Warning, "photon-boundary", o->where,
               fmt::format("{}: photons of map \"{}\" lie in clumps that are smaller than the reach of an irradiance estimate, which takes in what is between: too dark "
                           "(more photons, --photons)",
                           objectName(*o), map));
  report("photon-bent", figures.bent, "reach round what is curved: light is smeared over it");
}

}  // namespace tomales

#include "gi/atlas/limits.h"

#include <fmt/format.h>

namespace tomales {
namespace {

constexpr int64_t kFewEstimates = 32;  // A map with fewer estimates is not judged.
constexpr double kLeastOfPhotons = 0.01;
constexpr double kMost = 0.5;  // Share of estimates that may be unreliable.
constexpr double kClumped = 1.1;

/// Returns the first object whose light a map holds; null if there is none.
const Object* objectOf(const Scene& scene, const MapNames& names, const std::string& map) {
  for (size_t g = 0; g < scene.groups.size(); ++g)
    if (const int example = scene.groups[g].exampleObject;
        example >= 0 && (names.global[g] == map || names.caustic[g] == map))
      return &scene.objects[static_cast<size_t>(example)];
  return nullptr;
}

}  // namespace

void warnOfEstimates(const Scene& scene, const MapNames& names, const std::vector<MapFigures>& maps, Log& log) {
  uint64_t photons = 0;
  for (const MapFigures& m : maps) photons += m.photons;
  // `weight` is that of all estimates of a map; its mean should not exceed `most`.
  const auto report = [&](const char* code, const auto& weight, double most, const char* why) {
    const MapFigures* worst = nullptr;
    double worstMean = 0;
    int count = 0;
    for (const MapFigures& m : maps) {
      if (m.estimates.made < kFewEstimates ||
          static_cast<double>(m.photons) <= kLeastOfPhotons * static_cast<double>(photons))
        continue;
      const double mean = static_cast<double>(weight(m.estimates)) / static_cast<double>(m.estimates.made);
      count += mean > most;
      if (mean > most && mean > worstMean) {
        worst = &m;
        worstMean = mean;
      }
    }
    const Object* o = worst ? objectOf(scene, names, worst->map) : nullptr;
    if (o)
      log.report(
          Severity::Warning, code, o->where,
          fmt::format("{}: irradiance estimates of photon map \"{}\" {}{} (more photons, --photons)", objectName(*o),
                      worst->map, why, count > 1 ? fmt::format("; likewise {} other maps", count - 1) : ""));
  };
  report(
      "photon-few", [](const EstimateFigures& f) { return f.few; }, kMost,
      "have fewer photons in reach than they ask for: light is smeared and noisy");
  report(
      "photon-bent", [](const EstimateFigures& f) { return f.bent; }, kMost,
      "are averages over an area that bends with the surface: light is smeared over it");
  report(
      "photon-boundary", [](const EstimateFigures& f) { return f.clumps; }, kClumped,
      "are averages over an area that is larger than the surface: they are too dark");
}

}  // namespace tomales

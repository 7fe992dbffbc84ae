#include "gi/atlas/limits.h"

#include <fmt/format.h>

#include "gi/world_from_current.h"
#include "reyes/camera.h"

namespace tomales {
namespace {

constexpr int64_t kFewEstimates = 32;  // A map with fewer estimates is not judged.
constexpr double kLeastOfPhotons = 0.01;
constexpr double kMost = 0.5;  // Share of estimates that may be unreliable.
constexpr double kClumped = 1.1;
constexpr double kMostOfPicture = 0.25;  // Share of the lit picture that may rest on few photons.

/// Returns the first shade group whose light a map holds; null if there is none.
const ShadeGroup* groupOf(const Scene& scene, const MapNames& names, const std::string& map) {
  for (size_t g = 0; g < scene.groups.size(); ++g)
    if (names.global[g] == map || names.caustic[g] == map) return &scene.groups[g];
  return nullptr;
}

/// Warns if estimates from few photons make much of the picture. Returns false if it did not warn.
bool warnOfFewShown(const Scene& scene, const MapNames& names, const std::vector<MapFigures>& maps, Log& log) {
  PictureShare shown, few;
  const MapFigures* worst = nullptr;
  for (const MapFigures& m : maps) {
    shown += m.estimates.shown;
    few += m.estimates.shownFew;
    if (!worst || m.estimates.shownFew.pixels > worst->estimates.shownFew.pixels) worst = &m;
  }
  const ShadeGroup* g = few.pixels > kMostOfPicture * shown.pixels ? groupOf(scene, names, worst->map) : nullptr;
  if (!g) return false;
  log.report(
      Severity::Warning, "photon-few", g->where,
      fmt::format(
          "{}: {:.0f} % of the lit picture, about pixel {:.0f},{:.0f}, show where irradiance estimates have very "
          "few photons in reach: indirect light is smeared there, and may be wrong by factors "
          "(--gi gather, or more photons, --photons)",
          objectName(*g), 100 * few.pixels / shown.pixels, few.x / few.pixels, few.y / few.pixels));
  return true;
}

}  // namespace

ShownDisk shownBy(const RayScene& rays) {
  const Scene& scene = rays.scene();
  return [&rays, camera = Camera(scene.options), current = scene.cameraFromWorldAtOpen(),
          world = WorldFromCurrent(scene)](const vec3& worldP, const vec3& worldN, float worldRadius) {
    constexpr float kLift = 0.1f;  // of the radius: coarse polygons are not where their surface is
    const vec3 P = transformPoint(current, worldP), N = normalizeOr(world.currentNormals * worldN, vec3(0));
    const vec3 I = camera.incident(P);
    const float radius = worldRadius / world.scale, cosine = -dot(normalizeOr(I, vec3(0)), N);
    if (!(cosine > 0) || !camera.seeable(P) || camera.clips(P)) return PictureShare{};
    const vec2 at = camera.raster(P);
    if (!(at.x >= 0 && at.y >= 0 && at.x < static_cast<float>(camera.xResolution()) &&
          at.y < static_cast<float>(camera.yResolution())))
      return PictureShare{};
    const vec3 start = P + kLift * radius * N;
    Ray ray{start, -normalizeOr(I, vec3(0))};
    ray.tMax = camera.perspective() ? glm::length(I) : P.z - camera.nearClip();
    if (rays.closest(ray, kMaskPhoton).object >= 0) return PictureShare{};
    const double pixels = kPi * cosine * std::pow(double{radius / camera.pixelSize(P)}, 2);
    return PictureShare{pixels, pixels * at.x, pixels * at.y};
  };
}

void warnOfEstimates(const Scene& scene, const MapNames& names, const std::vector<MapFigures>& maps, Log& log) {
  uint64_t photons = 0;
  for (const MapFigures& m : maps) photons += m.photons;
  // `weight` returns a sum over all estimates of a map, whose mean should not exceed `most`.
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
    const ShadeGroup* g = worst ? groupOf(scene, names, worst->map) : nullptr;
    if (g)
      log.report(
          Severity::Warning, code, g->where,
          fmt::format("{}: irradiance estimates of photon map \"{}\" {}{} (more photons, --photons)", objectName(*g),
                      worst->map, why, count > 1 ? fmt::format("; likewise {} other maps", count - 1) : ""));
  };
  if (!warnOfFewShown(scene, names, maps, log))
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

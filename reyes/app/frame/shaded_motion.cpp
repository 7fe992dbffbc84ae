#include "reyes/app/frame/shaded_motion.h"

#include <fmt/format.h>

#include "raytrace/emitters.h"
#include "reyes/dice.h"

namespace tomales {
namespace {

constexpr int kAcross = 8;     ///< Points along each edge of an object's patches, all patches together.
constexpr float kOff = 0.15f;  ///< Mean relative error that is reported.
/// Limit of the number of lights times the number of groups that are examined: a warning must not cost as much as a
/// frame.
constexpr size_t kMostPairs = 4096;

struct Place {
  vec3 P, N;
};

class MovedLight {
 public:
  MovedLight(const RayScene& rays, const ShadingSystem& shading) : rays_(rays), shading_(shading) {}

  /// Returns the relative difference of the light between the two ends of the motion. The picture shows the light at
  /// the first end, so its mean error is half of that.
  float change(const LightList& lights, const std::vector<Place>& first, const std::vector<Place>& last) const {
    std::vector<float> a(first.size(), 0), b(first.size(), 0);
    for (const int l : lights) {
      add(l, first, a);
      add(l, last, b);
    }
    float differs = 0, sum = 0;
    for (size_t i = 0; i < a.size(); ++i) {
      differs += std::abs(a[i] - b[i]);
      sum += 0.5f * (a[i] + b[i]);
    }
    return sum > 0 ? differs / sum : 0;
  }

 private:
  /// Adds E/pi of a light with a place or a direction, or the colour of an ambient light.
  void add(int light, const std::vector<Place>& places, std::vector<float>& out) const {
    const LightKind kind = shading_.light(light).kind();
    const bool isAmbient = kind == LightKind::Ambient;
    if (kind != LightKind::Point && kind != LightKind::Distant && kind != LightKind::Area && !isAmbient) return;
    LightProbe probe;
    for (const Place& p : places) {
      probe.P.push_back(p.P);
      probe.N.push_back(p.N);
    }
    std::vector<float> pdf(places.size(), 1);
    const bool isArea = kind == LightKind::Area;
    if (isArea && !onEmitter(light, probe, pdf)) return;
    shading_.probe(light, probe);
    for (size_t i = 0; i < places.size(); ++i) {
      const vec3 L = isArea ? probe.Pl[i] - places[i].P : probe.L[i];
      const float cosine = isAmbient ? 1 : std::max(0.0f, dot(places[i].N, normalizeOr(L, vec3(0))));
      if (pdf[i] > 0) out[i] += luminance(probe.Cl[i]) * cosine / (isArea ? kPi * pdf[i] : 1);
    }
  }

  /// Sets for each place a point in the middle of the emitter, and its density over solid angle.
  bool onEmitter(int light, LightProbe& probe, std::vector<float>& pdf) const {
    const size_t n = probe.P.size();
    std::vector<float> from[3], P[3], N[3], middle(n, 0.5f), met(n);
    for (int k = 0; k < 3; ++k) {
      for (const vec3& p : probe.P) from[k].push_back(p[k]);
      P[k].resize(n);
      N[k].resize(n);
    }
    const EmitterPoints points{
        {P[0].data(), P[1].data(), P[2].data()}, {N[0].data(), N[1].data(), N[2].data()}, pdf.data(), met.data()};
    if (!rays_.emitters().sampleFrom(light, static_cast<int>(n), {from[0].data(), from[1].data(), from[2].data()},
                                     middle.data(), middle.data(), points))
      return false;
    for (size_t i = 0; i < n; ++i) {
      probe.Pl.emplace_back(P[0][i], P[1][i], P[2][i]);
      probe.Nl.emplace_back(N[0][i], N[1][i], N[2][i]);
    }
    return true;
  }

  const RayScene& rays_;
  const ShadingSystem& shading_;
};

/// Returns points of an object that face the eye when the shutter opens.
std::vector<Place> placesOn(const Scene& scene, int object) {
  std::vector<Place> out;
  const auto patches = static_cast<uint32_t>(scene.objects[static_cast<size_t>(object)].shape().patchCount());
  const uint32_t stride = std::max(1u, patches / (kAcross * kAcross)),
                 across = patches < kAcross ? kAcross : 1u;  // few patches are large ones
  for (uint32_t patch = 0; patch < patches; patch += stride)
    for (uint32_t k = 0; k < across * across; ++k) {
      const auto at = [&](uint32_t i) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(across); };
      const TrueSurface s = surfaceAt(scene, object, patch, at(k % across), at(k / across));
      if (dot(s.normal, s.P) < 0) out.push_back({s.P, glm::normalize(s.normal)});
    }
  return out;
}

/// Returns some of the groups that move before the eye, from all over the scene.
std::vector<const ShadeGroup*> movingGroups(const Scene& scene) {
  std::vector<const ShadeGroup*> all, out;
  if (!scene.options.shutterIsOpen() || scene.lights.empty()) return out;
  for (const ShadeGroup& g : scene.groups)
    if (g.currentFromOpen.moving() && g.exampleObject >= 0 && g.attributes->visibility.camera && !g.attributes->matte &&
        !g.attributes->volume)
      all.push_back(&g);
  const size_t stride = 1 + all.size() * scene.lights.size() / kMostPairs;
  for (size_t k = 0; k < all.size(); k += stride) out.push_back(all[k]);
  return out;
}

/// Returns the pixel of the first of these places that is in the picture; nothing if none is.
std::optional<vec2> pixelOf(const std::vector<Place>& places, const Camera& camera) {
  for (const Place& p : places)
    if (camera.seeable(p.P))
      if (const vec2 at = camera.raster(p.P); at.x >= 0 && at.y >= 0 &&
                                              at.x < static_cast<float>(camera.xResolution()) &&
                                              at.y < static_cast<float>(camera.yResolution()))
        return at;
  return std::nullopt;
}

}  // namespace

void warnOfShadedMotion(const RayScene& rays, const Camera& camera, const ShadingSystem& shading, Log& log) {
  const Scene& scene = rays.scene();
  const MovedLight light(rays, shading);
  float most = 2 * kOff;
  const ShadeGroup* worst = nullptr;
  vec2 pixel(0);
  for (const ShadeGroup* g : movingGroups(scene)) {
    const std::vector<Place> first = placesOn(scene, g->exampleObject);
    const mat4 moved = g->currentFromOpen.at(scene.options.shutterClose);
    std::vector<Place> last;
    for (const Place& p : first)
      last.push_back({transformPoint(moved, p.P), normalizeOr(glm::transpose(glm::inverse(mat3(moved))) * p.N, p.N)});
    const std::optional<vec2> begins = pixelOf(first, camera), ends = pixelOf(last, camera);
    const float change = begins || ends ? light.change(g->attributes->lights, first, last) : 0;
    if (!(change > most)) continue;
    most = change;
    worst = g;
    pixel = begins ? *begins : *ends;
  }
  if (!worst) return;
  log.report(
      Severity::Warning, "motion-light", worst->where,
      fmt::format("{}: light on it changes by {:.0f} % as it moves, but its whole blur, as at pixel {:.0f},{:.0f}, has "
                  "the light of shutter open, so that parts err by half of this: shorten Shutter, or "
                  "render parts of it and average the pictures",
                  objectName(*worst), 100 * most, pixel.x, pixel.y));
}

}  // namespace tomales

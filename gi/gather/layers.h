// Private to gi: rays that pass through transparent surfaces. Each goes on behind its hit until it is opaque enough.
#pragma once
#include "raytrace/trace.h"

namespace tomales {

constexpr int kMostLayers = 64;  ///< Greatest number of transparent surfaces that one ray goes through.

struct RayLayers {
  std::vector<Ray> rays;
  std::vector<SampleName> names;
  std::vector<int> elements;        ///< The caller's number of the element that each ray belongs to.
  std::vector<vec3> transmittance;  ///< Transmittance from the current start of each ray back to its first origin.
  /// For each ray, the ray that hit the surface behind which it starts; empty before the first goOn().
  std::vector<Ray> came;
  std::vector<Hit> left;  ///< The hit on that surface.

  void add(int element, const Ray& ray, SampleName name);

  /// Finds the nearest hits of the rays that go on. Returns how many rays started at a recorded hit of the hit list.
  int64_t meet(const RayScene& scene, RayMask mask, std::vector<Hit>& hits) const;

  /// Takes the colours and opacities that rays bring, also those that have met nothing but a Volume, and calls
  /// `brings(element, colour at the first origin, transmittance that remains)` for each. It keeps the rays whose
  /// opacity so far is below `opacityThreshold`.
  template <class Brings>
  void goOn(const RayScene& scene, const std::vector<Hit>& hits, const HitAnswers& answers, float opacityThreshold,
            const Brings& brings) {
    size_t kept = 0;
    came.clear();
    left.clear();
    for (size_t r = 0; r < rays.size(); ++r) {
      // A shader result that is not finite would cost the whole point.
      const vec3 color = isFinite(answers.color[r]) ? transmittance[r] * answers.color[r] : vec3(0);
      const vec3 passes = transmittance[r] * (1.0f - glm::clamp(answers.opacity[r], 0.0f, 1.0f));
      brings(elements[r], color, passes);
      if (hits[r].object < 0) continue;
      if (maxComponent(passes) <= 1 - std::min(opacityThreshold, 0.9999f) || hits[r].t >= rays[r].tMax) continue;
      came.push_back(rays[r]);
      left.push_back(hits[r]);
      keep(kept++, r, behind(scene, rays[r], hits[r]), passes);
    }
    resize(kept);
  }

 private:
  static Ray behind(const RayScene& scene, const Ray& ray, const Hit& hit);
  void keep(size_t to, size_t from, const Ray& ray, const vec3& passes);
  void resize(size_t count);
};

}  // namespace tomales

// Private to gi: rays on their way through what is transparent. Each goes on behind what it meets until enough of it is
// covered.
#pragma once
#include "raytrace/trace.h"

namespace tomales {

constexpr int kMostLayers = 64;  ///< Transparent surfaces that one ray goes through.

struct RayLayers {
  std::vector<Ray> rays;
  std::vector<SampleName> names;
  std::vector<int> elements;  ///< Whose ray it is, by the caller's count.
  std::vector<vec3> clear;    ///< What passes from there to the start.
  std::vector<Ray> came;      ///< How each came to the surface behind which it starts; empty before the first goOn(),
  std::vector<Hit> left;      ///< and that surface.

  void add(int element, const Ray& ray, SampleName name);

  /// Nearest hits, of those rays that go on. Returns how many started at a recorded hit.
  int64_t meet(const RayScene& scene, RayMask mask, std::vector<Hit>& hits) const;

  /// Given the colours and opacities of what they met, tells `brings(element, colour at its start, what stays clear)`
  /// and keeps the rays that go on, which are covered by less than `opacityThreshold`.
  template <class Brings>
  void goOn(const RayScene& scene, const std::vector<Hit>& hits, const HitAnswers& answers, float opacityThreshold,
            const Brings& brings) {
    size_t kept = 0;
    came.clear(), left.clear();
    for (size_t r = 0; r < rays.size(); ++r) {
      if (hits[r].object < 0) continue;
      // One bad shader result would cost the whole point.
      const vec3 color = isFinite(answers.color[r]) ? clear[r] * answers.color[r] : vec3(0);
      const vec3 passes = clear[r] * (1.0f - glm::clamp(answers.opacity[r], 0.0f, 1.0f));
      brings(elements[r], color, passes);
      if (maxComponent(passes) <= 1 - std::min(opacityThreshold, 0.9999f) || hits[r].t >= rays[r].tMax) continue;
      came.push_back(rays[r]), left.push_back(hits[r]);
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

// Private to raytrace: the Volumes of a scene, which rays cross (reyes/density.h). Their transmission is computed
// exactly; the volume shader decides the light that they scatter.
#pragma once
#include "raytrace/trace.h"
#include "reyes/density.h"

namespace tomales {

class Volumes {
 public:
  Volumes(const Scene& scene, const ShadingSystem& shading);

  bool none() const { return list_.empty(); }
  /// Returns the share of light that passes along a ray up to tMax.
  vec3 passed(const Ray& ray, float tMax, uint32_t mask) const;
  /// Implements RayScene::throughVolumes().
  void cross(const std::vector<Ray>& rays, const std::vector<float>& ends, const std::vector<SampleName>& names,
             uint32_t mask, const ShadingSystem& shading, const ShadeContext& context, HitAnswers& answers) const;

 private:
  struct Volume {
    const DensityGrid* density;
    int group;
    uint32_t mask;
    mat4 objectFromCurrent;
    vec3 extinction;  ///< Extinction for each unit of density and of length in the world.
  };
  /// A ray in one Volume.
  struct Crossing {
    uint32_t ray;
    const Volume* volume;
    float enters, leaves;
  };
  bool seenBy(const Ray& ray, const Volume& volume, uint32_t mask) const;
  float unitAlong(const vec3& direction) const { return glm::length(transformVector(worldFromCurrent_, direction)); }
  void crossOne(std::span<const Crossing> crossings, const std::vector<Ray>& rays, const std::vector<SampleName>& names,
                uint32_t turn, const ShadingSystem& shading, const ShadeContext& context, HitAnswers& answers) const;

  std::vector<Volume> list_;
  mat4 worldFromCurrent_;
};

}  // namespace tomales

// Private to gi: what surfaces do with photons. Diffuse ones are asked of their shaders, once for a whole
// group where the answer is the same everywhere. Threads: const members may be called concurrently.
#pragma once
#include <optional>

#include "gi/photons.h"
#include "raytrace/trace.h"

namespace tomales {

class PhotonSurfaces {
 public:
  /// What a diffuse surface does with light that falls on it: shares of it, 0 to 1.
  struct Answer {
    vec3 reflected{0.0f};  ///< Diffusely
    vec3 opacity{1.0f};
  };

  /// Names of models that there are not are reported, and taken for matte.
  PhotonSurfaces(const RayScene& rays, const ShadingSystem& shading, uint32_t seed, Log& log);

  PhotonModel model(int group) const { return models_[static_cast<size_t>(group)]; }
  bool isDiffuse(int group) const {
    return model(group) == PhotonModel::Matte || model(group) == PhotonModel::Translucent;
  }
  /// Of a group that does the same everywhere, or is never asked; null: ask().
  const Answer* even(int group) const {
    const auto& answer = even_[static_cast<size_t>(group)];
    return answer ? &*answer : nullptr;
  }
  /// At every hit.
  std::vector<Answer> ask(const std::vector<Ray>& rays, const std::vector<Hit>& hits,
                          const std::vector<SampleName>& names) const;

 private:
  std::optional<Answer> evenAnswer(int group) const;

  const RayScene& rays_;
  const ShadingSystem& shading_;
  const uint32_t seed_;
  std::vector<PhotonModel> models_;          ///< Of each group,
  std::vector<std::optional<Answer>> even_;  ///< and what it does with light if that is the same everywhere.
};

}  // namespace tomales

// Private to gi: what surfaces do with photons. For diffuse surfaces their shaders decide. They are evaluated once for
// a whole group if the answer is the same everywhere. Threads: const members may be called concurrently.
#pragma once
#include <optional>

#include "gi/photons.h"
#include "raytrace/trace.h"

namespace tomales {

class PhotonSurfaces {
 public:
  /// Shares of incident light at a diffuse surface, 0 to 1.
  struct Answer {
    vec3 reflected{0.0f};  ///< The diffusely reflected share.
    vec3 opacity{1.0f};
  };

  /// Reports unknown names of models and takes them for matte.
  PhotonSurfaces(const RayScene& rays, const ShadingSystem& shading, uint32_t seed, Log& log);

  PhotonModel model(int group) const { return models_[static_cast<size_t>(group)]; }
  bool isDiffuse(int group) const { return !isMirrorOrGlass(model(group)) && model(group) != PhotonModel::Transparent; }
  /// Returns the answer of a group that is the same everywhere, or never needed; null: call ask().
  const Answer* even(int group) const {
    const auto& answer = even_[static_cast<size_t>(group)];
    return answer ? &*answer : nullptr;
  }
  /// Evaluates the shaders at every hit.
  std::vector<Answer> ask(const std::vector<Ray>& rays, const std::vector<Hit>& hits,
                          const std::vector<SampleName>& names) const;

 private:
  std::optional<Answer> evenAnswer(int group) const;

  const RayScene& rays_;
  const ShadingSystem& shading_;
  const uint32_t seed_;
  std::vector<PhotonModel> models_;          ///< Indexed by group.
  std::vector<std::optional<Answer>> even_;  ///< The answer of each group where it is the same everywhere.
};

}  // namespace tomales

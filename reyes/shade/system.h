// Private to ShadingSystem: declarations that its source files share.
#pragma once
#include <chrono>

#include "reyes/shade/bound_scene.h"
#include "reyes/shade/light_noise.h"
#include "reyes/shade/light_use.h"

namespace tomales {

struct ShadingSystem::Impl : BoundScene {
  using BoundScene::BoundScene;
  LightNoise lightNoise{lights.size()};
  LightUse lightUse{lights.size()};
};

/// Adds the time between its construction and destruction to the figures of a shader.
class ShaderTimer {
 public:
  ShaderTimer(Stats& stats, const BoundShader& shader, int vertices)
      : stats_(stats), shader_(shader), vertices_(vertices), start_(Clock::now()) {}
  ~ShaderTimer() {
    stats_.addShader(shader_.shader->name, vertices_, std::chrono::duration<double>(Clock::now() - start_).count());
  }
  ShaderTimer(const ShaderTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  Stats& stats_;
  const BoundShader& shader_;
  const int vertices_;
  const Clock::time_point start_;
};

}  // namespace tomales

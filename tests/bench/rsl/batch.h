// A batch of 256 points on a wavy patch, under lights at infinity, as shaders and loops by hand see it; and a renderer
// that answers from it at once, so that what is timed is the shader.
#pragma once
#include <array>
#include <deque>
#include <string>
#include <vector>

#include "reyes/base/simd.h"
#include "reyes/shader.h"

namespace tomales::bench {

constexpr int kPoints = 256, kLights = 4;

struct Light {
  TmConstVec3 L;  ///< The unit vector towards the light.
  rsl::Color Cl;
};

class Batch {
 public:
  Batch();
  Batch(const Batch&) = delete;

  TmGrid grid{};
  std::vector<Light> lights;
  /// Its changes over one micropolygon.
  TmConstVec3 PStepU{}, PStepV{};
  const float *sStep = nullptr, *tStep = nullptr;
  /// Values of parameters: the defaults.
  void bind(const TmShader& shader);
  /// "shader" from "current" space.
  static constexpr float kSpace[3][4] = {{0.8f, -0.6f, 0, 0.3f}, {0.6f, 0.8f, 0, -0.2f}, {0, 0, 1, -4}};
  /// Gives the values that texture() finds, of one channel or three.
  static void lookUp(const TmGrid* g, const float* s, const float* t, TmVec3 out);

 private:
  float* array();
  TmVec3 triple();
  void setServices();
  std::deque<AlignedVector<float>> arrays_;
  std::deque<std::string> texts_;
  std::vector<TmValue> params_;
  AlignedVector<uint8_t> active_;
  TmServices services_{};
};

}  // namespace tomales::bench

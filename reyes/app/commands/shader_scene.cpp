#include "reyes/app/commands/shader_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "reyes/dice.h"

namespace tomales {
namespace {

constexpr const char* kSquare = "Patch \"bilinear\" \"P\" [-.5 .5 0  .5 .5 0  -.5 -.5 0  .5 -.5 0]\n";
constexpr float kLightDistance = 2;  // its distance from the eye, in front of the square and beside the way to it

std::string requestFor(const TmShader& shader, const std::string& parameters) {
  static constexpr const char* kRequests[] = {
      "Surface \"{}\" {}\n", "Attribute \"displacementbound\" \"sphere\" [1e9]\nDisplacement \"{}\" {}\n",
      "LightSource \"{}\" \"tested\" {}\n", "Atmosphere \"{}\" {}\n", "Imager \"{}\" {}\n"};
  if (shader.capabilities & TM_LIGHT_AREA)
    return fmt::format(
        "AttributeBegin AreaLightSource \"{}\" \"tested\" {} Translate 0 0 {} {}AttributeEnd\nIlluminate \"tested\" "
        "1\n",
        shader.name, parameters, kLightDistance, kSquare);
  return fmt::format(fmt::runtime(kRequests[shader.kind]), shader.name, parameters);
}

class EmptySpace final : public ShadeServices {
 public:
  void transmission(const ShadePoints&, const uint8_t*, TmConstVec3, const ShadowRays&, const ShadeContext&,
                    TmVec3) const override {}
  void trace(const ShadePoints& points, const uint8_t* active, TmConstVec3, TmConstVec3, const RayQuery&,
             const ShadeContext&, const RayResult& result) const override {
    for (int i = 0; i < points.count(); ++i) {
      if (!active[i]) continue;
      for (float* distance : {result.distance, result.effective})
        if (distance) distance[i] = kInfinity;
      for (const TmVec3& v : {result.color, result.opacity})
        if (v.x) v.x[i] = v.y[i] = v.z[i] = 0;
      if (result.leaves) result.leaves[i] = 1;
    }
  }
  /// Samples the square of requestFor(), which sends its light away from the eye.
  bool sampleEmitter(int, int count, TmConstVec3 from, const float* xi0, const float* xi1,
                     const EmitterPoints& out) const override {
    for (int i = 0; i < count; ++i) {
      const vec3 P(xi0[i] - 0.5f, xi1[i] - 0.5f, kLightDistance), way = get(from, i) - P;
      const float cosine = glm::normalize(way).z;
      set(out.P, i, P);
      set(out.N, i, vec3(0, 0, 1));
      out.pdf[i] = cosine > 0 ? glm::dot(way, way) / cosine : 0.0f;
      out.meetPdf[i] = 0;
    }
    return true;
  }
  void meetEmitter(int, int count, TmConstVec3, TmConstVec3, const EmitterPoints& out) const override {
    std::fill_n(out.pdf, count, 0.0f);
  }
  float emitterReach(int) const override { return 0; }
  float emitterArea(int) const override { return 1; /* of the square */ }
  void indirectDiffuse(const ShadePoints&, const uint8_t*, TmConstVec3, const IndirectQuery&, const ShadeContext&,
                       IndirectResult) const override {}
};

}  // namespace

std::string shaderSceneRib(const TmShader& shader, const std::string& parameters) {
  const std::string request = requestFor(shader, parameters);
  const bool isImager = shader.kind == TM_IMAGER;
  return "Projection \"perspective\" \"fov\" [20]\nClipping 1 10\n" + (isImager ? request : "") + "WorldBegin\n" +
         (shader.kind == TM_LIGHT ? ""
                                  : "LightSource \"ambientlight\" \"a\" \"intensity\" [0.2] LightSource "
                                    "\"distantlight\" \"d\" \"to\" [0.3 -0.4 1]\n") +
         (shader.kind == TM_SURFACE ? "" : "Surface \"matte\"\n") + (isImager ? "" : request) + "Translate 0 0 5\n" +
         kSquare + "WorldEnd\n";
}

ShadePoints shaderScenePoints(const Scene& scene, const ShadingSystem& shading, const std::array<int, 2>& size) {
  const int object = static_cast<int>(scene.objects.size()) - 1;  // a lamp may be before it
  const int group = scene.objects.back().group;
  ShadePoints points(group, 0, shading.group(group).wantsSteps());
  for (int j = 0; j < size[1]; ++j)
    for (int i = 0; i < size[0]; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(size[0]),
                  v = (static_cast<float>(j) + 0.5f) / static_cast<float>(size[1]);
      const int k = points.add(static_cast<uint32_t>(j * size[0] + i));
      evaluatePoint(scene, object, 0, u, v, points, k);
      if (points.hasSteps())
        evaluateSteps(scene, object, 0, u, v, 0.5f / static_cast<float>(std::max(size[0], size[1])), points, k);
      points.channel(kDu)[k] = 1 / static_cast<float>(size[0]);
      points.channel(kDv)[k] = 1 / static_cast<float>(size[1]);
      points.set3(kIx, k, points.position(k));
      points.channel(kTime)[k] = -1;
    }
  return points;
}

std::unique_ptr<ShadeServices> emptySpaceFor(const TmShader& shader) {
  if (!(shader.capabilities & (TM_TRACES | TM_LIGHT_AREA))) return nullptr;
  return std::make_unique<EmptySpace>();
}

}  // namespace tomales

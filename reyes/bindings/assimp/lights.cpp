#include "reyes/bindings/assimp/lights.h"

#include <fmt/format.h>

namespace tomales::model {
namespace {

struct Placed {
  const aiLight* light;
  std::string handle;
  mat4 world;
  vec3 from, direction;
  /// Strength in RSL's units: E/pi at distance 1, or anywhere for distant lights; radiance for areas.
  vec3 strength;
  float arriving = 0;  ///< E/pi in the middle of the lit world.
};

/// Returns a strength for 1 / d^2 that has the same effect in the middle of the lit world as the model's attenuation, 1
/// / (c + l d + q d^2).
float inverseSquareOf(const aiLight& light, float distance) {
  const float at = light.mAttenuationConstant + light.mAttenuationLinear * distance +
                   light.mAttenuationQuadratic * distance * distance;
  return at > 0 && std::isfinite(at) ? distance * distance / at : 1;
}

Placed placed(const aiLight& light, const mat4& world, const LightSettings& settings) {
  Placed out{&light, of(light.mName), world, {}, {}, {}, 0};
  out.from = transformPoint(world, of(light.mPosition));
  out.direction = normalizeOr(transformVector(world, of(light.mDirection)), vec3(0, -1, 0));
  out.strength = of(light.mColorDiffuse) * (settings.isGltf ? 1 / kPi : 1.0f);
  if (!isFinite(out.strength)) out.strength = vec3(0.0f);
  const vec3 toward = settings.world.center() - out.from;
  const float distance = std::max(glm::length(toward), 1e-3f * glm::length(settings.world.size()));
  const bool isDistant = light.mType == aiLightSource_DIRECTIONAL || light.mType == aiLightSource_AMBIENT,
             isArea = light.mType == aiLightSource_AREA;
  if (!isDistant && !isArea) out.strength *= inverseSquareOf(light, distance);
  const float area = isArea ? light.mSize.x * light.mSize.y / kPi : 1;
  out.arriving = luminance(out.strength) * (isDistant ? 1 : area / std::max(distance * distance, 1e-20f));
  return out;
}

/// Assimp's readers of other formats than glTF give whole angles.
float halfAngle(float angle, const LightSettings& settings) {
  return glm::clamp(settings.isGltf ? angle : angle / 2, 0.0f, kPi / 2);
}

Requests areaLight(const Placed& p, float scale) {
  const aiLight& light = *p.light;
  const vec3 up = normalizeOr(transformVector(p.world, of(light.mUp)), vec3(0, 1, 0)),
             right = normalizeOr(cross(p.direction, up), vec3(1, 0, 0)), above = cross(right, p.direction);
  const vec3 x = right * light.mSize.x / 2.0f, y = above * light.mSize.y / 2.0f;
  std::vector<float> P;
  for (const vec3& corner : {p.from - x + y, p.from + x + y, p.from + x - y, p.from - x - y})
    P.insert(P.end(), {corner.x, corner.y, corner.z});  // counterclockwise as what is lit sees it
  return {
      call("AttributeBegin"),
      callWith({param("lightcolor", ValueType::Color, p.strength * scale)}, "AreaLightSource", "arealight", p.handle),
      callWith({variable("P", Storage::Vertex, ValueType::Point, std::move(P))}, "Polygon"), call("AttributeEnd"),
      call("Illuminate", p.handle, 1.0f)};
}

Requests requestsOf(const Placed& p, float scale, const LightSettings& settings) {
  const ParamList look{param("lightcolor", ValueType::Color, p.strength * scale)};
  const auto source = [&](const char* shader, ParamList more) {
    ParamList list = look;
    list.insert(list.end(), more.begin(), more.end());
    return Requests{callWith(std::move(list), "LightSource", shader, p.handle)};
  };
  const Param from = param("from", ValueType::Point, p.from),
              to = param("to", ValueType::Point, p.from + p.direction * std::max(1.0f, glm::length(p.from)));
  switch (p.light->mType) {
    case aiLightSource_AMBIENT:
      return source("ambientlight", {});
    case aiLightSource_DIRECTIONAL:
      return source("distantlight",
                    {param("from", ValueType::Point, -p.direction), param("to", ValueType::Point, vec3(0.0f))});
    case aiLightSource_POINT:
      return source("pointlight", {from});
    case aiLightSource_AREA:
      return areaLight(p, scale);
    case aiLightSource_UNDEFINED:  // treated as a small area, which shines forward with the cosine
      return source("spotlight", {from, to, param("coneangle", kPi / 2), param("conedeltaangle", 0.0f),
                                  param("beamdistribution", 1.0f)});
    default: {
      const float outer = halfAngle(p.light->mAngleOuterCone, settings),
                  inner = std::min(outer, halfAngle(p.light->mAngleInnerCone, settings));
      return source("spotlight", {from, to, param("coneangle", outer), param("conedeltaangle", outer - inner),
                                  param("beamdistribution", 0.0f)});
    }
  }
}

const Request& shadowsOn() {
  static const Request request = callWith({param("shadows", std::string("on"))}, "Attribute", "light");
  return request;
}

}  // namespace

Lights lightsOf(const aiScene& scene, const Nodes& nodes, const LightSettings& settings) {
  Lights out;
  std::vector<Placed> all;
  float arriving = 0;
  for (unsigned k = 0; k < scene.mNumLights; ++k) {
    const aiLight& light = *scene.mLights[k];
    const auto node = nodes.worldFromNode.find(of(light.mName));
    if (light.mType == aiLightSource_UNDEFINED) ++out.unknown;
    all.push_back(placed(light, node == nodes.worldFromNode.end() ? mat4(1.0f) : node->second, settings));
    all.back().handle = fmt::format("{} {}", k + 1, all.back().handle);
    if (std::isfinite(all.back().arriving)) arriving += all.back().arriving;
  }
  constexpr float kDim = 0.3f, kBright = 3;
  const bool isLit = arriving == 0 || (arriving > kDim && arriving < kBright);
  out.scale = settings.scale > 0 ? settings.scale : isLit ? 1 : 1 / arriving;
  if (!all.empty()) out.requests.push_back(shadowsOn());
  for (const Placed& p : all)
    for (Request& r : requestsOf(p, out.scale, settings)) out.requests.push_back(std::move(r));
  return out;
}

Requests studioLights(const mat4& worldFromCamera) {
  constexpr float kSun = 0.75f, kSky = 0.35f;
  const vec3 toward = transformVector(worldFromCamera, normalizeOr(vec3(-0.5f, 0.7f, -0.6f), vec3(0.0f)));
  return {shadowsOn(),
          callWith({param("intensity", kSun), param("from", ValueType::Point, toward),
                    param("to", ValueType::Point, vec3(0.0f))},
                   "LightSource", "distantlight", "key"),
          callWith({param("intensity", kSky)}, "LightSource", "environmentlight", "sky")};
}

}  // namespace tomales::model

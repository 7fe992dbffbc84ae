#include "reyes/shade/ray_shots.h"

#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/shade/footprint.h"
#include "reyes/shade/primary.h"

namespace tomales {
namespace {

/// The default of PRMan's Option "trace" "specularthreshold": rays of wider cones are diffuse.
constexpr float kSpecularCone = 10 * kPi / 180;
constexpr uint32_t kConeStream = randomStream("cone"), kBaseStream = randomStream("base");

}  // namespace

TmRayOptions drawnRayOptions(const Batch& batch, const TmRayOptions* given) {
  TmRayOptions options = givenOptions(batch, tmRayDefaults(), given);
  options.samples = std::clamp(options.samples, 1, kMostSamples);
  options.drawn = std::clamp(options.drawn, 0, 1 << 14);
  options.number = std::clamp(options.number, 0, std::max(0, options.drawn - 1));
  options.coneAngle = std::clamp(options.coneAngle, 0.0f, kPi / 2);
  return options;
}

TmRayOptions rayOptions(const Batch& batch, const TmRayOptions* given) {
  TmRayOptions options = drawnRayOptions(batch, given);
  options.drawn = options.number = 0;
  return options;
}

RayQuery rayQuery(const TmRayOptions& o, RayKind kind) {
  const auto text = [](const char* s) { return std::string(s ? s : ""); };
  RayQuery q;
  q.kind = kind;
  q.maxDistance = o.maxDistance;
  q.bias = o.bias;
  q.label = text(o.label);
  q.subset = text(o.subset);
  q.excludeSubset = text(o.excludeSubset);
  q.sides = o.hitSides == TM_HIT_FRONT ? HitSides::Front : o.hitSides == TM_HIT_BACK ? HitSides::Back : HitSides::Both;
  if (o.hitMode != TM_HIT_DEFAULT) q.mode = o.hitMode == TM_HIT_PRIMITIVE ? HitMode::Primitive : HitMode::Shader;
  q.opacityThreshold = o.opacityThreshold;
  q.count = std::max(1, o.drawn) * o.samples;
  q.number = o.number * o.samples;
  q.seesAreaLights = o.passLamps == 0;
  q.importance = std::clamp(o.importance, 0.0f, 1.0f);
  return q;
}

RayQuery rayQuery(const TmRayOptions& o) {
  return rayQuery(o, o.coneAngle > kSpecularCone ? RayKind::Diffuse : RayKind::Specular);
}

Cone::Cone(Batch& batch, const TmGrid* g, const TmRayOptions& options)
    : batch_(batch),
      g_(g),
      options_(options),
      origin_(batch.arena.vec3(g->count)),
      direction_(batch.arena.vec3(g->count)) {}

void Cone::aim(TmConstVec3 P, TmConstVec3 axis, int ray) {
  forActive(g_, [&](int i) {
    set(direction_, i, around(get(axis, i), random(i, ray, kConeStream)));
    set(origin_, i, get(P, i) + spread(i, ray));
  });
}

vec2 Cone::random(int i, int ray, uint32_t stream) const {
  const SampleName name = batch_.points->name(i);
  const auto number = static_cast<uint32_t>(options_.number * options_.samples + ray);
  const uint32_t index = name.sequence * static_cast<uint32_t>(options_.samples * std::max(1, options_.drawn)) + number;
  return sobol2(index, hashCombine(name.key, stream, batch_.context.seed,
                                   static_cast<uint32_t>(batch_.context.diffuseDepth + batch_.context.specularDepth)));
}

vec3 Cone::around(const vec3& axis, const vec2& xi) const {
  const vec3 n = normalizeOr(axis, vec3(0));
  if (options_.coneAngle <= 0 || n == vec3(0)) return n;
  vec3 tangent, bitangent;
  orthonormalBasis(n, tangent, bitangent);
  vec3 local;
  if (options_.uniform) {
    const float z = 1 - xi.x * (1 - std::cos(options_.coneAngle)), r = std::sqrt(std::max(0.0f, 1 - z * z));
    local = {r * std::cos(2 * kPi * xi.y), r * std::sin(2 * kPi * xi.y), z};
  } else {
    const vec3 c = cosineHemisphere(xi);
    const vec2 d = vec2(c) * std::sin(options_.coneAngle);
    local = {d, std::sqrt(std::max(0.0f, 1 - dot(d, d)))};
  }
  return local.x * tangent + local.y * bitangent + local.z * n;
}

vec3 Cone::spread(int i, int ray) const {
  if (options_.sampleBase <= 0 || !g_->du) return vec3(0);
  const vec2 xi = (random(i, ray, kBaseStream) - 0.5f) * options_.sampleBase;
  return xi.x * g_->du[i] * get(g_->dPdu, i) + xi.y * g_->dv[i] * get(g_->dPdv, i);
}

void setFootprints(Batch& batch, const TmGrid* g, TmConstVec3 axis, const TmRayOptions& options, RayQuery& query) {
  float *radius = batch.arena.floats(g->count), *spread = batch.arena.floats(g->count);
  turnOf(batch, g, axis, spread);
  const float share = options.coneAngle / std::sqrt(static_cast<float>(options.samples));
  forActive(g, [&](int i) {
    radius[i] = micropolygonRadius(*batch.points, g, i);
    spread[i] = std::min(0.5f * spread[i] + share, 1.0f);
  });
  query.radius = radius;
  query.spread = spread;
}

bool traces(const Batch& batch) {
  if (batch.points && !batch.scene.services)
    batch.report(Severity::Missing, "shader-traces", "traces rays, but has not declared TM_TRACES; they meet nothing");
  return batch.points && batch.scene.services;
}

}  // namespace tomales

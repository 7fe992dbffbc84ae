#include "reyes/shade/ray_services.h"

#include <algorithm>
#include <span>
#include <string_view>

#include "reyes/base/rng.h"
#include "reyes/shade/footprint.h"
#include "reyes/shade/primary.h"
#include "reyes/shade/volumes.h"

namespace tomales {
namespace {

constexpr float kSpecularCone = 10 * kPi / 180;  ///< trace:specularthreshold of rispec-table 3.2: wider rays are diffuse.
constexpr float kFar = 1e30f;                    ///< RI_INFINITY: the distance to nothing
constexpr float kWholeCone = 0.999f * kPi / 2;   ///< Shaders say pi/2 with few digits.
constexpr float kVariationOfError = 0.05f;       ///< That maxerror 1 allows.
constexpr uint32_t kConeStream = 0x636f6e65U, kBaseStream = 0x62617365U;

TmRayOptions drawnOptionsOf(const TmRayOptions* given) {
  TmRayOptions options = givenOptions<TmRayOptions>(TM_RAY_DEFAULTS, given);
  options.samples = std::clamp(options.samples, 1, 1 << 16);
  options.drawn = std::clamp(options.drawn, 0, 1 << 14);
  options.number = std::clamp(options.number, 0, std::max(0, options.drawn - 1));
  options.coneAngle = std::clamp(options.coneAngle, 0.0f, kPi / 2);
  return options;
}

int floatsOf(const TmRayOutput& o) { return o.floats == 3 ? 3 : 1; }

/// Of services other than trace(), which draw all their directions themselves.
TmRayOptions optionsOf(const TmRayOptions* given) {
  TmRayOptions options = drawnOptionsOf(given);
  options.drawn = options.number = 0;
  return options;
}

RayQuery queryOf(const TmRayOptions& o, RayKind kind) {
  const auto text = [](const char* s) { return std::string(s ? s : ""); };
  RayQuery q;
  q.kind = kind;
  q.maxDistance = o.maxDistance, q.bias = o.bias;
  q.label = text(o.label), q.subset = text(o.subset), q.excludeSubset = text(o.excludeSubset);
  q.sides = o.hitSides == TM_HIT_FRONT ? HitSides::Front : o.hitSides == TM_HIT_BACK ? HitSides::Back : HitSides::Both;
  if (o.hitMode != TM_HIT_DEFAULT) q.mode = o.hitMode == TM_HIT_PRIMITIVE ? HitMode::Primitive : HitMode::Shader;
  q.opacityThreshold = o.opacityThreshold;
  q.count = std::max(1, o.drawn) * o.samples;
  q.number = o.number * o.samples;
  q.lampsGlow = o.passLamps == 0;
  return q;
}

RayQuery queryOf(const TmRayOptions& o) { return queryOf(o, o.coneAngle > kSpecularCone ? RayKind::Diffuse : RayKind::Specular); }

/// Ray `ray` of all points: a cone around each axis, and the places that they start from.
class Cone {
 public:
  Cone(Batch& batch, const TmGrid* g, const TmRayOptions& options)
      : batch_(batch), g_(g), options_(options), origin_(batch.arena.vec3(g->count)), direction_(batch.arena.vec3(g->count)) {}

  void aim(TmConstVec3 P, TmConstVec3 axis, int ray) {
    forActive(g_, [&](int i) {
      set(direction_, i, around(get(axis, i), random(i, ray, kConeStream)));
      set(origin_, i, get(P, i) + spread(i, ray));
    });
  }
  TmConstVec3 origin() const { return view(origin_); }
  TmConstVec3 direction() const { return view(direction_); }

 private:
  vec2 random(int i, int ray, uint32_t stream) const {
    const SampleName name = batch_.points->name(i);
    const auto number = static_cast<uint32_t>(options_.number * options_.samples + ray);
    const uint32_t index = name.sequence * static_cast<uint32_t>(options_.samples * std::max(1, options_.drawn)) + number;
    return sobol2(index, hashCombine(name.key, stream, batch_.context.seed, static_cast<uint32_t>(batch_.context.depth + batch_.context.specularDepth)));
  }
  vec3 around(const vec3& axis, const vec2& xi) const {
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
  vec3 spread(int i, int ray) const {
    if (options_.sampleBase <= 0 || !g_->du) return vec3(0);
    const vec2 xi = (random(i, ray, kBaseStream) - 0.5f) * options_.sampleBase;
    return xi.x * g_->du[i] * get(g_->dPdu, i) + xi.y * g_->dv[i] * get(g_->dPdv, i);
  }

  Batch& batch_;
  const TmGrid* g_;
  const TmRayOptions& options_;
  TmVec3 origin_, direction_;
};

/// Differentials: a ray starts as wide as its micropolygon, and widens by how the axis turns over that and by its share of the cone.
void setFootprints(Batch& batch, const TmGrid* g, TmConstVec3 axis, const TmRayOptions& options, RayQuery& query) {
  float *radius = batch.arena.floats(g->count), *spread = batch.arena.floats(g->count);
  turnOf(batch, g, axis, spread);
  const float share = options.coneAngle / std::sqrt(static_cast<float>(options.samples));
  forActive(g, [&](int i) { radius[i] = micropolygonRadius(*batch.points, g, i), spread[i] = std::min(0.5f * spread[i] + share, 1.0f); });
  query.radius = radius, query.spread = spread;
}

/// Can this batch trace? Reports a shader that cannot because it did not say that it would.
bool traces(const Batch& batch) {
  if (batch.points && !batch.scene.services)
    batch.report(Severity::Missing, "shader-traces", "traces rays, but has not declared TM_TRACES; they meet nothing");
  return batch.points && batch.scene.services;
}

/// What occlusion() asks.
OcclusionQuery occlusionOf(const TmRayOptions& o, const RayQuery& rays, const Attributes& a) {
  OcclusionQuery q{o.samples, o.maxDistance, o.bias, o.falloff, o.falloffMode, o.maxVariation, rays.subset, rays.excludeSubset, rays.sides};
  if (q.maxVariation < 0) q.maxVariation = kVariationOfError * a.irradianceMaxError.value_or(0.0f);
  return q;
}

/// Could earlier records answer? They lie at the points of batches that the eye sees, and hold whole hemispheres.
bool isInterpolated(const Batch& batch, const TmGrid* g, TmConstVec3 P, const TmRayOptions& o, const OcclusionQuery& q) {
  if (!(q.maxVariation > 0) || batch.context.kind != RayKind::Camera || o.uniform || o.coneAngle < kWholeCone || o.sampleBase > 0) return false;
  for (int i = 0; i < g->count; ++i)
    if (g->active[i] && get(P, i) != batch.points->position(i)) return false;
  return true;
}

}  // namespace

void traceRays(void* host, const TmGrid* all, TmConstVec3 P, TmConstVec3 direction, const TmRayOptions* given, TmVec3 color, float* distance) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  const TmGrid* g = primary.grid();
  const TmRayOptions options = drawnOptionsOf(given);
  forActive(all, [&](int i) {
    if (color.x) set(color, i, vec3(0));
    if (distance) distance[i] = kFar;
  });
  if (!traces(batch)) return;
  Cone cone(batch, g, options);
  RayQuery query = queryOf(options);
  setFootprints(batch, g, direction, options, query);
  RayResult result;
  result.distance = batch.arena.floats(g->count);
  if (color.x) result.color = batch.arena.vec3(g->count), result.opacity = batch.arena.vec3(g->count);
  for (int ray = 0; ray < options.samples; ++ray, ++query.number) {
    cone.aim(P, direction, ray);
    batch.scene.services->trace(*batch.points, g->active, cone.origin(), cone.direction(), query, batch.context, result);
    if (color.x) crossVolumes(batch, g, cone.origin(), cone.direction(), result.distance, result.color, result.opacity);
    forActive(g, [&](int i) {
      if (color.x) set(color, i, get(color, i) + get(result.color, i) / static_cast<float>(options.samples));
      if (distance) distance[i] = std::min(distance[i], result.distance[i]);
    });
  }
  primary.spread(color), primary.spread(distance);
}

int32_t gatherRays(void* host, const TmGrid* all, TmConstVec3 P, TmConstVec3 axis, const TmRayOptions* given, int32_t ray, uint8_t* hit,
                   const TmRayOutput* outputs, int32_t outputCount) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  const TmGrid* g = primary.grid();
  const TmRayOptions options = optionsOf(given);
  if (ray < 0 || ray >= options.samples || !traces(batch)) return 0;
  Cone cone(batch, g, options);
  cone.aim(P, axis, ray);
  RayQuery query = queryOf(options);
  setFootprints(batch, g, axis, options, query);
  query.number = ray;
  RayResult result;
  result.distance = batch.arena.floats(g->count);
  std::vector<const TmRayOutput*> ofRay;
  for (const TmRayOutput& o : std::span(outputs, static_cast<size_t>(outputCount))) {
    const std::string_view name = o.name;
    if (name.starts_with("ray:"))
      ofRay.push_back(&o);
    else
      result.outputs.push_back({o.name, floatsOf(o), {o.c[0], o.c[1], o.c[2]}});
  }
  batch.scene.services->trace(*batch.points, g->active, cone.origin(), cone.direction(), query, batch.context, result);
  forActive(g, [&](int i) {
    hit[i] = result.distance[i] < kFar;
    for (const TmRayOutput* o : ofRay) {
      const std::string_view name = o->name;
      const vec3 value = name == "ray:origin"      ? get(cone.origin(), i)
                         : name == "ray:direction" ? get(cone.direction(), i)
                                                   : vec3(std::min(result.distance[i], kFar));
      for (int k = 0; k < floatsOf(*o); ++k) o->c[k][i] = value[k];
    }
  });
  primary.spread(hit);
  for (const TmRayOutput& o : std::span(outputs, static_cast<size_t>(outputCount)))
    for (int k = 0; k < floatsOf(o); ++k) primary.spread(o.c[k]);
  return 1;
}

void occlusion(void* host, const TmGrid* all, TmConstVec3 P, TmConstVec3 N, const TmRayOptions* given, float* covered, TmVec3 radiance) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  const TmGrid* g = primary.grid();
  TmRayOptions options = optionsOf(given);
  if (options.coneAngle == 0) options.coneAngle = kPi / 2;
  forActive(all, [&](int i) {
    covered[i] = 0;
    if (radiance.x) set(radiance, i, vec3(0));
  });
  if (!traces(batch)) return;
  Cone cone(batch, g, options);
  RayQuery query = queryOf(options, RayKind::Diffuse);
  const OcclusionQuery asked = occlusionOf(options, query, *batch.group.group->attributes);
  if (!radiance.x && isInterpolated(batch, g, P, options, asked) &&
      batch.scene.services->interpolatedOcclusion(*batch.points, g->active, N, asked, batch.context, covered))
    return primary.spread(covered);
  setFootprints(batch, g, N, options, query);
  RayResult result;
  result.distance = batch.arena.floats(g->count);
  if (radiance.x) result.color = batch.arena.vec3(g->count);
  const float share = 1 / static_cast<float>(options.samples);
  for (; query.number < options.samples; ++query.number) {
    cone.aim(P, N, query.number);
    batch.scene.services->trace(*batch.points, g->active, cone.origin(), cone.direction(), query, batch.context, result);
    forActive(g, [&](int i) {
      covered[i] += share * asked.coveredAt(result.distance[i]);
      if (radiance.x) set(radiance, i, get(radiance, i) + share * get(result.color, i));
    });
  }
  primary.spread(covered), primary.spread(radiance);
}

void transmissionWith(void* host, const TmGrid* all, TmConstVec3 P, TmConstVec3 toward, const TmRayOptions* given, TmVec3 out) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  const TmGrid* g = primary.grid();
  const TmRayOptions options = optionsOf(given);
  forActive(all, [&](int i) { set(out, i, vec3(1)); });
  if (!traces(batch) || batch.context.kind == RayKind::Transmission) return;
  Cone cone(batch, g, options);
  const RayQuery query = queryOf(options, RayKind::Transmission);
  const TmVec3 path = batch.arena.vec3(g->count), clear = batch.arena.vec3(g->count), sum = batch.arena.vec3(g->count);
  ShadePoints moved = *batch.points;
  for (int s = 0; s < options.samples; ++s) {
    cone.aim(P, toward, s);
    forActive(g, [&](int i) {
      set(path, i, get(cone.direction(), i) * glm::length(get(toward, i)));
      set(clear, i, vec3(1));
      moved.set3(kPx, i, get(cone.origin(), i));
    });
    const ShadowRays rays{false, s, options.samples, &query};
    batch.scene.services->transmission(moved, g->active, view(path), rays, batch.context, clear);
    forActive(g, [&](int i) { set(sum, i, get(sum, i) + get(clear, i)); });
  }
  forActive(g, [&](int i) { set(out, i, get(sum, i) / static_cast<float>(options.samples)); });
  primary.spread(out);
}

int32_t rayInfo(void* host, const TmGrid* g, const char* name, TmVec3 out) {
  const Batch& batch = batchOf(host);
  const ShadeContext& c = batch.context;
  const std::string_view what = name;
  const auto number = [&](int value) {
    forActive(g, [&](int i) { out.x[i] = static_cast<float>(value); });
    return 1;
  };
  if (what == "type") return number(static_cast<int>(c.kind));
  if (what == "highlights") return number(c.kind != RayKind::Diffuse || c.highlights);
  if (what == "depth") return number(c.depth + c.specularDepth);
  if (what == "diffusedepth") return number(c.depth);
  if (what == "speculardepth") return number(c.specularDepth);
  if (what != "origin" && what != "direction" && what != "length") return 0;
  forActive(g, [&](int i) {
    const vec3 P = get(g->P, i), I = get(g->I, i);
    if (what == "length")
      out.x[i] = glm::length(I);
    else
      set(out, i, what == "origin" ? P - I : normalizeOr(I, vec3(0)));
  });
  return 1;
}

const char* rayLabel(void* host, const TmGrid*) { return batchOf(host).context.label.c_str(); }

}  // namespace tomales

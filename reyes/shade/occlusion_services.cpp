// occlusion() and indirectdiffuse(): answered by rays, by earlier records or by the disks of a point cloud.
#include <fmt/format.h>

#include "reyes/shade/cloud_services.h"
#include "reyes/shade/picture_services.h"
#include "reyes/shade/primary.h"
#include "reyes/shade/ray_shots.h"
#include "reyes/shade/services.h"
#include "reyes/shade/spaces.h"

namespace tomales {
namespace {

constexpr float kWholeCone = 0.999f * kPi / 2;  ///< Slightly less than pi/2, which shaders give with few digits.
/// The maxerror of the cache if none is given. Shading the hits of rays is expensive, so radiance is interpolated as
/// for an indirect light, and with it the occlusion of the same call.
const float kErrorOfCoverage = 0, kErrorOfRadiance = IndirectQuery().maxError;

/// Returns what a call of occlusion() or indirectdiffuse() asks.
HemisphereQuery queryOf(const TmRayOptions& o, const TmOcclusion& asked, const RayQuery& rays, const Attributes& a,
                        bool radiance) {
  HemisphereQuery q{.samples = o.samples,
                    .maxDistance = o.maxDistance,
                    .bias = o.bias,
                    .falloff = asked.falloff,
                    .falloffMode = asked.falloffMode,
                    .maxVariation = asked.maxVariation,
                    .radiance = radiance,
                    .mode = radiance ? rays.mode : std::nullopt,
                    .diffuseLimit = radiance ? a.trace.maxDiffuseDepth : 0,
                    .subset = a.trace.subsetFor(rays.subset),
                    .excludeSubset = rays.excludeSubset,
                    .sides = rays.sides};
  if (q.maxVariation < 0)
    q.maxVariation =
        kVariationOfError * a.irradianceMaxError.value_or(asked.radiance.x ? kErrorOfRadiance : kErrorOfCoverage);
  return q;
}

/// Answers from earlier records where possible, and returns the points that need rays. Records are at points that the
/// eye sees, and are about whole hemispheres.
const uint8_t* interpolate(Batch& batch, const TmGrid* g, TmConstVec3 P, TmConstVec3 N, const TmRayOptions& o,
                           const RayQuery& rays, const TmOcclusion& out) {
  const bool plain = batch.context.kind == RayKind::Camera && !o.uniform && o.coneAngle >= kWholeCone &&
                     o.sampleBase == 0 && !o.environment && !out.environmentColor.x && !out.environmentDirection.x;
  ShadeContext traced = batch.context;
  traced.purpose = Purpose::Picture;  // a rehearsal traces nothing
  if (!plain || (out.radiance.x && !rays.label.empty()) ||
      !batch.scene.services->tracesFrom(*batch.points, rays, traced))
    return g->active;
  uint8_t *own = batch.arena.bytes(g->count), *moved = batch.arena.bytes(g->count);
  for (int i = 0; i < g->count; ++i) {
    own[i] = g->active[i] && get(P, i) == batch.points->position(i);
    moved[i] = g->active[i] && !own[i];
  }
  const auto answered = [&](bool radiance, const TmVec3& answer) {
    const HemisphereQuery q = queryOf(o, out, rays, *batch.group.group->attributes, radiance);
    return q.maxVariation > 0 &&
           batch.scene.services->interpolatedHemisphere(*batch.points, own, N, q, batch.context, answer);
  };
  const TmVec3 covered = batch.arena.vec3(g->count), radiance = batch.arena.vec3(g->count);
  if ((out.covered && !answered(false, covered)) || (out.radiance.x && !answered(true, radiance))) return g->active;
  for (int i = 0; i < g->count; ++i) {
    if (!own[i]) continue;
    if (out.covered) out.covered[i] = covered.x[i];
    if (out.radiance.x) set(out.radiance, i, get(radiance, i));
  }
  return moved;
}

/// The picture that rays see where they meet nothing, looked up as environment() does.
struct OpenSky {
  const char* picture;
  mat3 toMap;
  float* angle;  ///< Angle in radians.
  TmVec3 direction, color;

  OpenSky(Batch& batch, const TmGrid* g, const TmRayOptions& o)
      : picture(o.environment),
        toMap(environmentDirections(batch, o.environmentSpace)),
        angle(batch.arena.floats(g->count)),
        direction(batch.arena.vec3(g->count)),
        color(batch.arena.vec3(g->count)) {
    std::fill_n(angle, g->count, std::sqrt(2 * kPi * (1 - std::cos(o.coneAngle)) / static_cast<float>(o.samples)));
  }
  void lookUp(Batch& batch, const TmGrid& open, TmConstVec3 along) {
    forActive(&open, [&](int i) { set(direction, i, toMap * get(along, i)); });
    TmTextureOptions options = tmTextureDefaults();
    options.angle = angle;
    environment(&batch, &open, picture, &options, view(direction), color);
  }
};

/// Returns false if nothing can be traced.
bool traceHemisphere(Batch& batch, const TmGrid* g, TmConstVec3 P, TmConstVec3 N, const TmRayOptions& options,
                     const TmOcclusion& out) {
  if (!traces(batch)) return false;
  const bool looksUp = options.environment && (out.radiance.x || out.environmentColor.x),
             directs = out.environmentDirection.x != nullptr;
  RayQuery query = rayQuery(options, RayKind::Diffuse);
  const HemisphereQuery asked = queryOf(options, out, query, *batch.group.group->attributes, false);
  TmGrid traced = *g;
  traced.active = interpolate(batch, g, P, N, options, query, out);
  if (std::none_of(traced.active, traced.active + traced.count, [](uint8_t a) { return a != 0; })) return true;
  if (!looksUp && !directs && !batch.scene.services->tracesFrom(*batch.points, query, batch.context)) return true;
  setFootprints(batch, &traced, N, options, query);
  RayResult result;
  result.distance = batch.arena.floats(g->count);
  if (out.radiance.x) result.color = batch.arena.vec3(g->count);
  const float share = 1 / static_cast<float>(options.samples);
  TmGrid open = traced;
  uint8_t* misses = batch.arena.bytes(g->count);
  open.active = misses;
  std::optional<OpenSky> sky;
  if (looksUp) sky.emplace(batch, g, options);
  Cone cone(batch, &traced, options);
  for (; query.number < options.samples; ++query.number) {
    const Batch::Scratch scratch(batch);
    cone.aim(P, N, query.number);
    batch.scene.services->trace(*batch.points, traced.active, cone.origin(), cone.direction(), query, batch.context,
                                result);
    for (int i = 0; i < traced.count; ++i) misses[i] = traced.active[i] && !(result.distance[i] < kRiInfinity);
    if (sky) sky->lookUp(batch, open, cone.direction());
    forActive(&traced, [&](int i) {
      const vec3 light = share * (misses[i] && sky ? get(sky->color, i) : vec3(0));
      if (out.covered) out.covered[i] += share * asked.coveredAt(result.distance[i]);
      if (out.radiance.x) set(out.radiance, i, get(out.radiance, i) + share * get(result.color, i) + light);
      if (out.environmentColor.x) set(out.environmentColor, i, get(out.environmentColor, i) + light);
      if (directs && misses[i])
        set(out.environmentDirection, i, get(out.environmentDirection, i) + get(cone.direction(), i));
    });
  }
  if (directs)
    forActive(&traced,
              [&](int i) { set(out.environmentDirection, i, normalizeOr(get(out.environmentDirection, i), vec3(0))); });
  return true;
}

/// Does the same with a point cloud.
bool hemisphereOfDisks(Batch& batch, const TmGrid* g, TmConstVec3 P, TmConstVec3 N, const TmRayOptions& o,
                       const TmOcclusion& out) {
  if (o.environment || out.environmentColor.x || out.environmentDirection.x || o.uniform || o.sampleBase > 0)
    batch.report(Severity::Missing, "shader-pointbased",
                 "asks a point cloud for environments, an even distribution or a sample base, which rays alone know; "
                 "they are left out");
  const DisksQuery query{out.pointChannel ? out.pointChannel : "_radiosity", std::max(out.maxSolidAngle, 1e-4f),
                         out.clamp != 0, o.coneAngle,
                         queryOf(o, out, rayQuery(o), *batch.group.group->attributes, false)};
  float* covered = out.covered ? out.covered : batch.arena.floats(g->count);
  return occlusionByDisks(batch, g, out.pointCloud, P, N, query, covered, out.radiance);
}

int32_t occlusion(void* host, const TmGrid* all, const TmRayOptions* given, TmConstVec3 P, TmConstVec3 N,
                  const TmOcclusion* wanted) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  TmRayOptions options = rayOptions(batch, given);
  if (options.coneAngle == 0) options.coneAngle = kPi / 2;
  options.samples = raysOfBranch(options.samples, kLeastOfHemisphere, batch.context);
  const TmOcclusion out = givenOptions(batch, tmOcclusionDefaults(), wanted);
  forActive(all, [&](int i) {
    if (out.covered) out.covered[i] = 0;
    for (const TmVec3& v : {out.radiance, out.environmentColor, out.environmentDirection})
      if (v.x) set(v, i, vec3(0));
  });
  if (out.radiance.x && batch.scene.added)
    batch.report(Severity::Note, "light-twice",
                 "asks indirectdiffuse() itself, and --gi has added an indirect light to what diffuse() sums: if it "
                 "calls both, bounced light counts twice; leave out --gi, or a call");
  const auto hemisphere = out.pointCloud ? hemisphereOfDisks : traceHemisphere;
  const bool known = hemisphere(batch, primary.grid(), P, N, options, out);
  primary.spread(out.covered);
  for (const TmVec3& v : {out.radiance, out.environmentColor, out.environmentDirection}) primary.spread(v);
  return known;
}

}  // namespace

void addOcclusionServices(TmServices& services) { services.occlusion = occlusion; }

}  // namespace tomales

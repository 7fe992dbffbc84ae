// Implements the calls of TmServices that trace rays. ray_shots.h has the cones, ShadeServices the rays.
#include "reyes/shade/ray_services.h"

#include <algorithm>
#include <span>
#include <string_view>

#include "reyes/shade/environment_rays.h"
#include "reyes/shade/primary.h"
#include "reyes/shade/ray_shots.h"
#include "reyes/shade/services.h"
#include "reyes/shade/volumes.h"

namespace tomales {
namespace {

int componentsOf(const TmChannel& c) { return c.value.y ? 3 : 1; }

}  // namespace

void setRayOutputs(const Primary& primary, const TmChannel* outputs, int32_t outputCount,
                   std::initializer_list<RayValue> known) {
  for (const TmChannel& o : std::span(outputs, static_cast<size_t>(outputCount))) {
    const auto* const it =
        std::find_if(known.begin(), known.end(), [&](const RayValue& v) { return v.name == o.name; });
    const float* const from[3] = {it != known.end() ? it->value.x : nullptr, it != known.end() ? it->value.y : nullptr,
                                  it != known.end() ? it->value.z : nullptr};
    float* const to[3] = {o.value.x, o.value.y, o.value.z};
    for (int k = 0; k < componentsOf(o); ++k) {
      if (from[k]) forActive(primary.grid(), [&](int i) { to[k][i] = from[k][i]; });
      primary.spread(to[k]);
    }
  }
}

namespace {

void trace(void* host, const TmGrid* all, const TmRayOptions* given, TmConstVec3 P, TmConstVec3 direction, TmVec3 color,
           float* distance) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  const TmGrid* g = primary.grid();
  TmRayOptions options = drawnRayOptions(batch, given);
  if (!distance) options.samples = raysOfBranch(options.samples, 1, batch.context);  // of distances, the least counts
  forActive(all, [&](int i) {
    if (color.x) set(color, i, vec3(0));
    if (distance) distance[i] = kRiInfinity;
  });
  if (!traces(batch)) return;
  Cone cone(batch, g, options);
  RayQuery query = rayQuery(options);
  setFootprints(batch, g, direction, options, query);
  RayResult result;
  result.distance = batch.arena.floats(g->count);
  if (color.x) {
    result.color = batch.arena.vec3(g->count);
    result.opacity = batch.arena.vec3(g->count);
  }
  // Diffuse rays return no sky, as they return no area lights: diffuse() has asked for that light.
  if (color.x && query.kind == RayKind::Specular && query.seesAreaLights &&
      batch.context.seesLightsInMirrors(batch.points->group()) && query.maxDistance >= kRiInfinity)
    result.leaves = batch.arena.bytes(g->count);
  for (int ray = 0; ray < options.samples; ++ray, ++query.number) {
    const Batch::Scratch scratch(batch);
    cone.aim(P, direction, ray);
    batch.scene.services->trace(*batch.points, g->active, cone.origin(), cone.direction(), query, batch.context,
                                result);
    if (result.leaves)
      batch.lights.addSkies(batch, cone.direction(), result.leaves, view(result.opacity), result.color);
    if (color.x) crossVolumes(batch, g, cone.origin(), cone.direction(), result.distance, result.color, result.opacity);
    forActive(g, [&](int i) {
      if (color.x) set(color, i, get(color, i) + get(result.color, i) / static_cast<float>(options.samples));
      if (distance) distance[i] = std::min(distance[i], result.distance[i]);
    });
  }
  primary.spread(color);
  primary.spread(distance);
}

/// The outputs of the rays of a call of gather(). Values of "volume:" are the values of the hit surface after the ray
/// has crossed the volumes of the asking surface.
struct Gathered {
  RayResult result;
  TmVec3 color{}, opacity{};  ///< volume:Ci and volume:Oi; null unless one is asked for.

  Gathered(Batch& batch, int count, std::span<const TmChannel> outputs) {
    result.distance = batch.arena.floats(count);
    std::fill_n(result.distance, count, kInfinity);
    for (const TmChannel& o : outputs) {
      const std::string_view name = o.name;
      if (name == "effectivedistance" && !result.effective) {
        result.effective = batch.arena.floats(count);
        result.color = batch.arena.vec3(count);
      } else if ((name == "volume:Ci" || name == "volume:Oi") && !color.x) {
        color = batch.arena.vec3(count);
        opacity = batch.arena.vec3(count);
        result.outputs.push_back({"surface:Ci", 3, {color.x, color.y, color.z}});
        result.outputs.push_back({"surface:Oi", 3, {opacity.x, opacity.y, opacity.z}});
      }
      if (!name.starts_with("ray:") && !name.starts_with("volume:") && name != "effectivedistance")
        result.outputs.push_back({o.name, componentsOf(o), {o.value.x, o.value.y, o.value.z}});
    }
  }

  /// Writes volume:Ci and volume:Oi where a ray has met something.
  void tellVolumes(const TmGrid* g, const uint8_t* hit, std::span<const TmChannel> outputs) const {
    for (const TmChannel& o : outputs) {
      const std::string_view name = o.name;
      if ((name != "volume:Ci" && name != "volume:Oi") || !o.value.y) continue;
      forActive(g, [&](int i) {
        if (hit[i]) set(o.value, i, get(name == "volume:Ci" ? color : opacity, i));
      });
    }
  }
};

bool asksForRays(const TmChannel* outputs, int32_t outputCount) {
  return std::any_of(outputs, outputs + outputCount, [](const TmChannel& o) {
    const std::string_view name = o.name;
    return name == "ray:origin" || name == "ray:direction";
  });
}

/// Answers for rays beyond the limit of their depth, of which nobody asks where they go.
int32_t gatherNothing(Batch& batch, const Primary& primary, const TmGrid* all, uint8_t* hit, const TmChannel* outputs,
                      int32_t outputCount) {
  forActive(all, [&](int i) { hit[i] = 0; });
  float* const far = batch.arena.floats(all->count);
  std::fill_n(far, all->count, kRiInfinity);
  setRayOutputs(primary, outputs, outputCount,
                {{"ray:length", {far, far, far}}, {"effectivedistance", {far, far, far}}});
  return 1;
}

int32_t gather(void* host, const TmGrid* all, const TmRayOptions* given, TmConstVec3 P, TmConstVec3 axis, int32_t ray,
               uint8_t* hit, const TmChannel* outputs, int32_t outputCount) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  const TmGrid* g = primary.grid();
  const TmRayOptions options = rayOptions(batch, given);
  const Batch::Scratch scratch(batch);
  if (options.environment) return gatherEnvironment(batch, all, P, options, ray, hit, outputs, outputCount);
  if (ray < 0 || ray >= options.samples || !traces(batch)) return 0;
  RayQuery query = rayQuery(options);
  if (!asksForRays(outputs, outputCount) && !batch.scene.services->tracesFrom(*batch.points, query, batch.context))
    return gatherNothing(batch, primary, all, hit, outputs, outputCount);
  Cone cone(batch, g, options);
  cone.aim(P, axis, ray);
  setFootprints(batch, g, axis, options, query);
  query.number = ray;
  Gathered gathered(batch, g->count, {outputs, static_cast<size_t>(outputCount)});
  const RayResult& result = gathered.result;
  if (options.maxDistance > 0)
    batch.scene.services->trace(*batch.points, g->active, cone.origin(), cone.direction(), query, batch.context,
                                result);
  if (gathered.color.x)
    crossVolumes(batch, g, cone.origin(), cone.direction(), result.distance, gathered.color, gathered.opacity);
  float *length = batch.arena.floats(g->count), *effective = batch.arena.floats(g->count);
  forActive(g, [&](int i) {
    hit[i] = result.distance[i] < kRiInfinity;
    length[i] = std::min(result.distance[i], kRiInfinity);
    effective[i] = result.effective ? std::min(result.effective[i], kRiInfinity) : kRiInfinity;
  });
  gathered.tellVolumes(g, hit, {outputs, static_cast<size_t>(outputCount)});
  primary.spread(hit);
  setRayOutputs(primary, outputs, outputCount,
                {{"ray:origin", cone.origin()},
                 {"ray:direction", cone.direction()},
                 {"ray:length", {length, length, length}},
                 {"effectivedistance", {effective, effective, effective}}});
  return 1;
}

void transmission(void* host, const TmGrid* all, const TmRayOptions* given, TmConstVec3 P, TmConstVec3 toward,
                  TmVec3 out) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  const TmGrid* g = primary.grid();
  const TmRayOptions options = rayOptions(batch, given);
  forActive(all, [&](int i) { set(out, i, vec3(1)); });
  if (!traces(batch) || batch.context.kind == RayKind::Transmission) return;
  Cone cone(batch, g, options);
  const RayQuery query = rayQuery(options, RayKind::Transmission);
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
  const auto number = [&](auto value) {
    forActive(g, [&](int i) { out.x[i] = static_cast<float>(value); });
    return 1;
  };
  if (what == "type") return number(static_cast<int>(c.kind));
  if (what == "highlights") return number(c.kind != RayKind::Diffuse || c.highlights == HitHighlights::All);
  if (what == "depth") return number(c.diffuseDepth + c.specularDepth);
  if (what == "diffusedepth") return number(c.diffuseDepth);
  if (what == "speculardepth") return number(c.specularDepth);
  if (what == "shadowdepth") return number(c.kind == RayKind::Transmission);
  if (what == "importance") return number(c.importance);
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

}  // namespace

void addRayServices(TmServices& services) {
  services.trace = trace;
  services.transmission = transmission;
  services.gather = gather;
  services.rayInfo = rayInfo;
  services.rayLabel = rayLabel;
}

}  // namespace tomales

// The functions behind TmServices.
#include <cstring>

#include "reyes/base/rng.h"
#include "reyes/shade/batch.h"
#include "reyes/shade/lobe.h"
#include "reyes/shade/ray_services.h"
#include "reyes/shade/spaces.h"

namespace tomales {
namespace {

Batch& batchOf(void* host) { return *static_cast<Batch*>(host); }

template <class Body>
void forActive(const TmGrid* g, const Body& body) {
  for (int i = 0; i < g->count; ++i)
    if (g->active[i]) body(i);
}

void fill(const TmGrid* g, TmVec3 out, const vec3& v) {
  forActive(g, [&](int i) { set(out, i, v); });
}

/// Sums weight(i, L, N) * Cl over the light samples on the side of N (RISpec 15.6: illuminance(P, N, PI/2)).
/// of the lights that count.
template <class Counts, class Weight>
void sumOverLights(Batch& batch, const TmGrid* g, TmConstVec3 N, const Counts& counts, TmVec3 out,
                   const Weight& weight) {
  const TmVec3 n = batch.arena.vec3(g->count);
  forActive(g, [&](int i) { set(n, i, normalizeOr(get(N, i), vec3(0.0f))); });
  fill(g, out, vec3(0.0f));
  uint8_t* facing = batch.arena.bytes(g->count);
  for (LightSample& sample : batch.lights.samples(batch)) {
    if (!counts(*sample.light)) continue;
    std::fill_n(facing, g->count, uint8_t{0});
    forActive(g, [&](int i) { facing[i] = dot(get(n, i), get(sample.L, i)) > 0; });
    batch.lights.shadow(batch, sample, facing);
    for (int i = 0; i < g->count; ++i)
      if (facing[i]) set(out, i, get(out, i) + get(sample.Cl, i) * weight(i, get(sample.L, i), get(n, i)));
  }
}

void diffuseOf(void* host, const TmGrid* g, int32_t which, TmConstVec3 N, TmVec3 out) {
  const auto counts = [which](const BoundLight& light) {
    return !light.nondiffuse && (which & (light.can(TM_LIGHT_INDIRECT) ? TM_INDIRECT_LIGHT : TM_DIRECT_LIGHT)) != 0;
  };
  sumOverLights(batchOf(host), g, N, counts, out, [](int, const vec3& L, const vec3& n) { return dot(L, n); });
}

void diffuse(void* host, const TmGrid* g, TmConstVec3 N, TmVec3 out) {
  diffuseOf(host, g, TM_DIRECT_LIGHT | TM_INDIRECT_LIGHT, N, out);
}

void ambient(void* host, const TmGrid* g, TmVec3 out) {
  batchOf(host).lights.ambient(batchOf(host), *g, out);
}

int32_t light(void* host, const TmGrid* g, int32_t index, TmLightSample* out) {
  Batch& batch = batchOf(host);
  std::vector<LightSample>& samples = batch.lights.samples(batch);
  if (index < 0 || index >= static_cast<int32_t>(samples.size())) return 0;
  LightSample& sample = samples[static_cast<size_t>(index)];
  batch.lights.shadow(batch, sample, g->active);
  *out = {view(sample.L), view(sample.Cl), sample.light->can(TM_LIGHT_INDIRECT), sample.light->nondiffuse,
          sample.light->nonspecular};
  return 1;
}

int32_t transform(void* host, const TmGrid* g, int32_t kind, const char* from, const char* to, TmConstVec3 in,
                  TmVec3 out) {
  const Batch& batch = batchOf(host);
  const std::optional<Space> a = findSpace(batch, from), b = findSpace(batch, to);
  const bool projected = a && b && (a->kind != Space::Linear || b->kind != Space::Linear);
  if (!a || !b || (projected && kind != TM_AS_POINT)) {
    forActive(g, [&](int i) { set(out, i, get(in, i)); });
    return 0;
  }
  const TmType type = kind == TM_AS_POINT ? TM_POINT : kind == TM_AS_NORMAL ? TM_NORMAL : TM_VECTOR;
  const mat4 toFromCurrent = glm::inverse(b->currentFromSpace), toFrom = toFromCurrent * a->currentFromSpace;
  forActive(g, [&](int i) {
    vec3 p = get(in, i);
    if (!projected) return set(out, i, transformAs(type, toFrom, p));
    p = a->kind == Space::Linear ? transformPoint(a->currentFromSpace, p)
                                 : currentFromProjected(batch, a->kind, p);
    p = b->kind == Space::Linear ? transformPoint(toFromCurrent, p) : projectedFromCurrent(batch, b->kind, p);
    set(out, i, p);
  });
  return 1;
}

int32_t texture(void* host, const TmGrid* g, const char* name, int32_t channel, int32_t channels,
                const float* s, const float* t, TmVec3 out) {
  Batch& batch = batchOf(host);
  // The footprint is known where the picture lies in the surface's own parameters; elsewhere a point is
  // looked up.
  float *width = batch.arena.floats(g->count), *height = batch.arena.floats(g->count);
  for (int i = 0; i < g->count; ++i) {
    if (s[i] == g->u[i]) width[i] = std::abs(g->du[i]);
    if (t[i] == g->v[i]) height[i] = std::abs(g->dv[i]);
  }
  const TextureQuery query{name, channel, channels, g->count, g->active, s, t, width, height};
  return batch.scene.textures.lookup(query, batch.running->where, batch.running->user, out);
}

int32_t environment(void* host, const TmGrid* g, const char* name, TmConstVec3 direction, const float* angle,
                    TmVec3 out) {
  Batch& batch = batchOf(host);
  const mat3 worldFromCurrent = glm::inverse(mat3(batch.scene.cameraFromWorld));
  const int n = g->count;
  float *s = batch.arena.floats(n), *t = batch.arena.floats(n);
  float *width = batch.arena.floats(n), *height = batch.arena.floats(n);
  forActive(g, [&](int i) {
    const vec3 d = normalizeOr(worldFromCurrent * get(direction, i), vec3(0, 0, 1));
    const vec2 st = latLong(d);
    s[i] = st.x, t[i] = st.y;
    if (!angle) return;
    height[i] = std::min(1.0f, angle[i] / kPi);
    width[i] = std::min(1.0f, angle[i] / (2 * kPi * std::max(std::sqrt(d.x * d.x + d.y * d.y), 1e-6f)));
  });
  const TextureQuery query{name, 0, 3, n, g->active, s, t, width, height, true};
  return batch.scene.textures.lookup(query, batch.running->where, batch.running->user, out);
}

void calculateNormal(void* host, const TmGrid* g, TmConstVec3 P, TmVec3 out) {
  const Batch& batch = batchOf(host);
  if (!batch.grid) return forActive(g, [&](int i) { set(out, i, get(g->N, i)); });
  Grid moved;
  moved.allocate(batch.grid->nu, batch.grid->nv, 1, 0);
  const size_t bytes = static_cast<size_t>(g->count) * sizeof(float);
  std::memcpy(moved.P(0, 0), P.x, bytes), std::memcpy(moved.P(0, 1), P.y, bytes),
      std::memcpy(moved.P(0, 2), P.z, bytes);
  const bool flip = batch.scene.scene.objects[static_cast<size_t>(batch.grid->object)].flipsNormal;
  calculateNormals(moved, flip, moved.N(0), moved.N(1), moved.N(2));
  forActive(g, [&](int i) { set(out, i, moved.normal(i)); });
}

void transmission(void* host, const TmGrid* g, TmConstVec3 P, TmConstVec3 toward, TmVec3 out) {
  transmissionWith(host, g, P, toward, nullptr, out);
}

/// Of a lookup that leaves it open: Option "shadow" "bias", or a random one between "bias0" and "bias1"; negative: as needed.
float shadowBias(const Options& options, uint32_t name) {
  const auto number = [&](const char* key) -> const Param* {
    const auto it = options.user.find(key);
    return it == options.user.end() ? nullptr : &it->second;
  };
  if (const Param* bias = number("shadow:bias")) return bias->number(-1);
  const Param *low = number("shadow:bias0"), *high = number("shadow:bias1");
  return low && high ? lerp(low->number(0), high->number(0), unitFloat(name)) : -1.0f;
}

void shadow(void* host, const TmGrid* g, const char* name, TmConstVec3 P, const TmShadowLookup* lookup, TmVec3 out) {
  const Batch& batch = batchOf(host);
  fill(g, out, vec3(0.0f));
  if (!batch.points || std::string_view(name) == "raytrace") return;
  const ShadowMap* map = batch.scene.shadowMaps.find(name, batch.running->where, batch.running->user);
  if (!map) return;
  const mat4 worldFromCurrent = glm::inverse(batch.scene.cameraFromWorld);
  forActive(g, [&](int i) {
    const ShadePoints& p = *batch.points;
    const auto edge = [&](int tangent, const float* step) {
      return transformVector(worldFromCurrent, p.get3(tangent, i) * step[i]);
    };
    const ShadowReceiver receiver{transformPoint(worldFromCurrent, get(P, i)),
                                  transformAs(TM_NORMAL, worldFromCurrent, p.get3(kNgx, i)), edge(kDpduX, g->du),
                                  edge(kDpdvX, g->dv)};
    const uint32_t seed = hashCombine(p.key(i), p.name(i).sequence, batch.context.seed);
    const float bias = lookup->bias < 0 ? shadowBias(batch.scene.scene.options, seed) : lookup->bias;
    set(out, i, map->shadow(receiver, {bias, lookup->blur, lookup->width, lookup->samples, seed}));
  });
}

/// Null: no light is running, or not of this group.
const BoundLight* runningLight(const Batch& batch) {
  for (const BoundLight* light : batch.group.lights)
    if (light->bound.get() == batch.running) return light;
  return nullptr;
}

IndirectQuery queryOf(const Batch& batch, const BoundLight* light) {
  if (!light) return batch.group.indirect.value_or(IndirectQuery{});
  IndirectQuery query = light->query;
  query.maxError = batch.group.group->attributes->irradianceMaxError.value_or(query.maxError);
  return query;
}

void gather(Batch& batch, const TmGrid* g, TmConstVec3 N) {
  auto& last = batch.gathered;
  const size_t bytes = static_cast<size_t>(g->count) * sizeof(float);
  if (last.who == batch.running && std::equal(g->active, g->active + g->count, last.active) &&
      !std::memcmp(last.N.x, N.x, bytes) && !std::memcmp(last.N.y, N.y, bytes) &&
      !std::memcmp(last.N.z, N.z, bytes))
    return;
  last.who = batch.running;
  last.active = batch.arena.bytes(g->count);
  std::copy_n(g->active, g->count, last.active);
  last.N = batch.arena.vec3(g->count), last.E = batch.arena.vec3(g->count);
  for (TmVec3& d : last.dominant) d = batch.arena.vec3(g->count);
  for (int i = 0; i < g->count; ++i) {
    set(last.N, i, get(N, i));
    for (const TmVec3& d : last.dominant) set(d, i, get(N, i));
  }
  const auto& attribute = batch.group.group->attributes->indirect;
  if (!batch.points || !batch.scene.services || !batch.context.indirect || !attribute.receive) return;
  IndirectResult result{last.E, {last.dominant[0], last.dominant[1], last.dominant[2]}};
  const BoundLight* light = runningLight(batch);
  batch.scene.services->indirectDiffuse(*batch.points, g->active, N, queryOf(batch, light), batch.context,
                                        result);
  const vec3 gain = attribute.gain * (light ? light->sourceTint : vec3(1.0f));
  forActive(g, [&](int i) { set(last.E, i, get(last.E, i) * gain); });
}

void indirectDiffuse(void* host, const TmGrid* g, TmConstVec3 N, TmVec3 out, TmVec3* dominant) {
  Batch& batch = batchOf(host);
  gather(batch, g, N);
  forActive(g, [&](int i) {
    set(out, i, get(batch.gathered.E, i));
    for (int k = 0; dominant && k < 3; ++k) set(dominant[k], i, get(batch.gathered.dominant[k], i));
  });
}

void report(void* host, const TmGrid*, int32_t severity, const char* message) {
  const Batch& batch = batchOf(host);
  batch.report(severity >= 2 ? Severity::Missing : Severity::Warning, "shader-says", message);
}

}  // namespace

const TmServices kServices = {
    sizeof(TmServices), diffuse,      specular,        ambient, light,      transform, texture,
    calculateNormal,    transmission, indirectDiffuse, report,  environment, diffuseOf, shadow,
    traceRays,          gatherRays,   occlusion,       transmissionWith, rayInfo, rayLabel,
    lightDensity,       lightAlong,   lobeSamples,     stratified};

}  // namespace tomales

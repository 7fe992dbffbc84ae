// Implements the calls of TmServices that are about light.
#include "reyes/shade/light_services.h"

#include <cstring>

#include "reyes/base/rng.h"
#include "reyes/shade/illuminate.h"
#include "reyes/shade/primary.h"
#include "reyes/shade/ray_shots.h"
#include "reyes/shade/remote_batch.h"
#include "reyes/shade/services.h"

namespace tomales {
namespace {

void fill(const TmGrid* g, TmVec3 out, const vec3& v) {
  forActive(g, [&](int i) { set(out, i, v); });
}

/// Returns the bias of a lookup without its own: Option "shadow" "bias", or a random one between "bias0" and "bias1";
/// negative if the map shall choose it.
float shadowBias(const Options& options, uint32_t seed) {
  if (const Param* bias = findParam(options.user, "shadow:bias")) return bias->number(-1);
  const Param *low = findParam(options.user, "shadow:bias0"), *high = findParam(options.user, "shadow:bias1");
  return low && high ? lerp(low->number(0), high->number(0), unitFloat(seed)) : -1.0f;
}

/// Returns null if no light is running, or none of this group.
const BoundLight* runningLight(const Batch& batch) {
  for (const int light : batch.group.lights())
    if (batch.scene.light(light).bound.get() == batch.running) return &batch.scene.light(light);
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
      !std::memcmp(last.N.x, N.x, bytes) && !std::memcmp(last.N.y, N.y, bytes) && !std::memcmp(last.N.z, N.z, bytes))
    return;
  last.who = batch.running;
  last.active = batch.arena.bytes(g->count);
  std::copy_n(g->active, g->count, last.active);
  last.N = batch.arena.vec3(g->count);
  last.E = batch.arena.vec3(g->count);
  for (TmVec3& d : last.dominant) d = batch.arena.vec3(g->count);
  for (int i = 0; i < g->count; ++i) {
    set(last.N, i, get(N, i));
    for (const TmVec3& d : last.dominant) set(d, i, get(N, i));
  }
  const auto& attribute = batch.group.group->attributes->indirect;
  if (!batch.points || !batch.scene.services || !batch.context.indirect || !attribute.receive) return;
  IndirectResult result{last.E, {last.dominant[0], last.dominant[1], last.dominant[2]}};
  const BoundLight* light = runningLight(batch);
  batch.scene.services->indirectDiffuse(*batch.points, g->active, N, queryOf(batch, light), batch.context, result);
  const vec3 gain = attribute.gain * (light ? light->sourceTint : vec3(1.0f));
  forActive(g, [&](int i) { set(last.E, i, get(last.E, i) * gain); });
}

bool matchesTerm(std::string_view categories, std::string_view term) {
  const bool excludes = term.starts_with('-');
  if (excludes) term.remove_prefix(1);
  bool has = false;
  for (size_t begin = 0; begin <= categories.size();) {
    const size_t end = std::min(categories.find(',', begin), categories.size());
    has = has || categories.substr(begin, end - begin) == term;
    begin = end + 1;
  }
  return has != excludes;
}

/// Returns the points that see a sample within the cone of an illuminance statement.
const uint8_t* litPoints(Batch& place, const TmGrid* g, const TmIlluminance& cone, const LightSample& sample) {
  uint8_t* lit = place.arena.bytes(place.tm.count);
  const float least = std::cos(cone.angle);
  forActive(g, [&](int i) {
    lit[i] = !cone.axis.x || dot(normalizeOr(get(cone.axis, i), vec3(0)), get(sample.L, i)) >=
                                 (cone.angles ? std::cos(cone.angles[i]) : least);
  });
  return lit;
}

/// Tells whether light comes from behind some of the points, as to cloth that is lit through.
bool comesFromBehind(const Batch& place, const TmGrid* g, const uint8_t* lit, const LightSample& sample) {
  if (!place.points || place.points->inAir()) return false;
  for (int i = 0; i < place.points->count(); ++i)
    if (g->active[i] && lit[i] && dot(place.points->facingNormal(i), get(sample.L, i)) <= 0 &&
        get(sample.Cl, i) != vec3(0.0f))
      return true;
  return false;
}

/// RISpec 15.6 defines diffuse() by illuminance(P, N, PI/2).
void diffuse(void* host, const TmGrid* all, int32_t which, TmConstVec3 N, TmVec3 out) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  const TmGrid* g = primary.grid();
  const TmVec3 n = batch.arena.vec3(g->count);
  normalizeAll(g->count, N, n);
  fill(g, out, vec3(0.0f));
  uint8_t* lit = batch.arena.bytes(g->count);
  float* share = batch.arena.floats(g->count);
  for (LightSample& sample : batch.lights.samples(batch)) {
    const BoundLight& light = *sample.light;
    const TmLightChoice is = light.can(TM_LIGHT_INDIRECT) ? TM_INDIRECT_LIGHT : TM_DIRECT_LIGHT;
    if (light.nondiffuse || (which != TM_ALL_LIGHT && which != is)) continue;
    markFacing(g->count, g->active, view(n), view(sample.L), lit);
    batch.lights.shadow(batch, sample, lit);
    setShares(g->count, lit, sample.nondiffuse, share);
    addDiffuse(g->count, share, view(n), view(sample.L), view(sample.Cl), out);
  }
  primary.spread(out);
}

void ambient(void* host, const TmGrid* g, TmVec3 out) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, g);
  batch.lights.ambient(batch, *primary.grid(), out);
  primary.spread(out);
}

int32_t illuminance(void* host, const TmGrid* g, TmIlluminance* out) {
  Batch& batch = batchOf(host);
  const TmIlluminance query = givenOptions(batch, tmIlluminanceDefaults(), out);
  if (out->structBytes < offsetof(TmIlluminance, nonspecular)) return 0;  // no room for the answer
  Batch& place = remoteBatchOf(batch, g, query);
  const std::string_view category = query.category ? query.category : "";
  const LightList& indirect = place.scene.indirect;
  place.lights.multiplySamples(query.times);
  std::vector<LightSample>& samples = place.lights.samples(
      place, std::any_of(indirect.begin(), indirect.end(), [&](int light) {
        return place.group.lights().contains(light) && inCategory(place.scene.light(light).category, category);
      }));
  auto next = static_cast<size_t>(std::max(query.next, 0));
  while (next < samples.size() && !inCategory(samples[next].light->category, category)) ++next;
  if (next >= samples.size()) return 0;
  LightSample& sample = samples[next];
  const Primary primary(batch, g);
  const uint8_t* lit = litPoints(place, primary.grid(), query, sample);
  place.lights.shadow(place, sample, lit);
  if (batch.context.kind == RayKind::Camera && !sample.fromBehind)
    sample.fromBehind = comesFromBehind(place, primary.grid(), lit, sample);
  const bool distant = sample.light->can(TM_LIGHT_SOLAR) || sample.light->can(TM_LIGHT_INDIRECT);
  const TmVec3 L = distant ? sample.L : sample.far;
  primary.spread(L);
  primary.spread(sample.L);
  primary.spread(sample.Cl);
  primary.spread(const_cast<uint8_t*>(lit));
  out->next = static_cast<int32_t>(next) + 1;
  out->light = lightNumber(batch, place, next);
  out->L = view(L);
  out->direction = view(sample.L);
  out->Cl = view(sample.Cl);
  out->lit = lit;
  out->isIndirect = sample.light->can(TM_LIGHT_INDIRECT);
  out->nondiffuse = sample.light->nondiffuse;
  out->nonspecular = sample.light->nonspecular;
  return 1;
}

void shadow(void* host, const TmGrid* all, const char* name, const TmShadowOptions* given, TmConstVec3 P, TmVec3 out) {
  const Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  const TmGrid* g = primary.grid();
  fill(all, out, vec3(0.0f));
  if (!batch.points || std::string_view(name) == "raytrace") return;
  const ShadowMap* map = batch.scene.shadowMaps.find(name, batch.running->where, batch.running->user);
  if (!map) return;
  TmShadowOptions options = givenOptions(batch, tmShadowDefaults(), given);
  options.samples = std::clamp(options.samples, 1, kMostSamples);
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
    const float bias = options.bias < 0 ? shadowBias(batch.scene.scene.options, seed) : options.bias;
    set(out, i, map->shadow(receiver, {bias, options.blur, options.width, options.samples, seed}));
  });
  primary.spread(out);
}

void indirectDiffuse(void* host, const TmGrid* all, TmConstVec3 N, TmVec3 out, TmVec3* dominant) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  const TmGrid* g = primary.grid();
  gather(batch, g, N);
  forActive(g, [&](int i) {
    set(out, i, get(batch.gathered.E, i));
    for (int k = 0; dominant && k < 3; ++k) set(dominant[k], i, get(batch.gathered.dominant[k], i));
  });
  primary.spread(out);
  for (int k = 0; dominant && k < 3; ++k) primary.spread(dominant[k]);
}

}  // namespace

bool inCategory(std::string_view categories, std::string_view expression) {
  if (expression.empty()) return true;
  for (size_t begin = 0; begin <= expression.size();) {
    const size_t end = std::min(expression.find_first_of(",|", begin), expression.size());
    const std::string_view alternative = expression.substr(begin, end - begin);
    bool all = true;
    for (size_t at = 0; at <= alternative.size();) {
      const size_t stop = std::min(alternative.find('&', at), alternative.size());
      all = all && matchesTerm(categories, alternative.substr(at, stop - at));
      at = stop + 1;
    }
    if (all) return true;
    begin = end + 1;
  }
  return false;
}

void addLightServices(TmServices& services) {
  services.ambient = ambient;
  services.diffuse = diffuse;
  services.illuminance = illuminance;
  services.indirectDiffuse = indirectDiffuse;
  services.shadow = shadow;
}

}  // namespace tomales

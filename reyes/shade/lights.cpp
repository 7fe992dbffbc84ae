#include "reyes/shade/lights.h"

#include "reyes/base/checksum.h"
#include "reyes/base/rng.h"
#include "reyes/shade/batch.h"
#include "reyes/shade/primary.h"

namespace tomales {
namespace {

bool applies(const BoundLight& light, const Batch& batch) {
  if (batch.points == nullptr) return false;  // displacement shaders see no light
  if (batch.context.light != Illumination::Lights || batch.context.kind == RayKind::Transmission) return false;
  if (!(batch.context.kind == RayKind::Diffuse ? light.indirect : light.direct)) return false;
  if (!light.can(TM_LIGHT_INDIRECT)) return batch.context.direct || batch.context.kind != RayKind::Camera;
  return batch.context.indirect && batch.group.group->attributes->indirect.receive;
}

/// Of the points, without neighbours; what the light brings has room for those.
TmGrid lightGrid(Batch& batch, const BoundLight& light) {
  TmGrid g = *Primary(batch, &batch.tm).grid();
  g.params = light.bound->values.data();
  g.L = batch.arena.vec3(batch.tm.count), g.Cl = batch.arena.vec3(batch.tm.count);
  return g;
}

/// Gives the outputs of a light room, so that lightsource() can read them.
void openOutputs(Batch& batch, const BoundShader& light, std::vector<TmValue>& params) {
  for (size_t i = 0; i < params.size(); ++i) {
    if (!isOutput(light.shader->params[i])) continue;
    const int width = (light.shader->params[i].type & ~TM_OUTPUT) == TM_FLOAT ? 1 : 3;
    for (int k = 0; k < width; ++k) params[i].c[k] = batch.arena.floats(batch.tm.count);
    params[i].step = 1;
  }
}

/// What is not finite is dark: the fault is the light's, not that of the surface that asks.
void darkenNonFinite(Batch& batch, const BoundShader& light, const TmGrid& g) {
  bool bad = false;
  for (int i = 0; i < g.count; ++i) {
    if (isFinite(get(g.Cl, i)) && isFinite(get(g.L, i))) continue;
    set(g.Cl, i, vec3(0)), set(g.L, i, vec3(0)), bad = true;
  }
  if (!bad) return;
  const BoundShader* caller = std::exchange(batch.running, &light);
  batch.report(Severity::Warning, "shader-not-finite", "returned NaN or infinity; it casts no light there");
  batch.running = caller;
}

/// Random numbers of sample number g.sample, by what the points are and never by their place in the batch.
void drawSample(Batch& batch, const BoundLight& light, TmGrid& g) {
  float* xi0 = batch.arena.floats(g.count);
  float* xi1 = batch.arena.floats(g.count);
  for (int i = 0; i < g.count; ++i) {
    const SampleName name = batch.points->name(i);
    const uint32_t stream = hashCombine(name.key, static_cast<uint32_t>(light.index), batch.context.seed);
    const vec2 xi = sobol2(name.sequence * static_cast<uint32_t>(g.samples) + static_cast<uint32_t>(g.sample), stream);
    xi0[i] = xi.x, xi1[i] = xi.y;
  }
  g.xi0 = xi0, g.xi1 = xi1;
}

/// Points on the emitter. False: the light has no geometry.
bool sampleEmitter(Batch& batch, const BoundLight& light, TmGrid& g, float* area) {
  if (!batch.scene.services) return false;
  const TmVec3 Pl = batch.arena.vec3(g.count), Nl = batch.arena.vec3(g.count);
  if (!batch.scene.services->sampleEmitter(light.index, g.count, g.xi0, g.xi1, Pl, Nl, area)) return false;
  g.Pl = view(Pl), g.Nl = view(Nl);
  for (int i = 0; i < g.count; ++i) set(g.L, i, get(g.Pl, i) - get(g.P, i));
  return true;
}

/// To points in front of those on the emitter, where nothing of its own is in the way.
TmVec3 beforeEmitter(Batch& batch, const TmGrid& g, float reach) {
  if (reach == 0) return g.L;
  const TmVec3 toward = batch.arena.vec3(g.count);
  for (int i = 0; i < g.count; ++i) set(toward, i, get(g.L, i) + reach * get(g.Nl, i));
  return toward;
}

/// Radiance of the emitter -> what one of its samples adds to E/pi at normal incidence: Cl cos(light) area /
/// (pi d^2).
void radianceToSample(const TmGrid& g, const float* area) {
  for (int i = 0; i < g.count; ++i) {
    const vec3 L = get(g.L, i);
    const float d2 = dot(L, L), d = std::sqrt(d2);
    const float cosLight = d > 0 ? -dot(get(g.Nl, i), L) / d : 0.0f;
    // Rounding leaves points of the emitter's own plane slightly in front of it, at no distance at all.
    const float weight =
        cosLight > 1e-5f ? cosLight * area[i] / (kPi * d2 * static_cast<float>(g.samples)) : 0.0f;
    set(g.Cl, i, weight > 0 ? get(g.Cl, i) * weight : vec3(0.0f));
  }
}

uint64_t sumOf(TmConstVec3 toward, int n, const ShadowRays& rays) {
  uint64_t sum = 2 * static_cast<uint64_t>(rays.samples) + rays.solar;
  for (const float* axis : {toward.x, toward.y, toward.z}) sum = 31 * sum + checksum(std::as_bytes(std::span(axis, static_cast<size_t>(n))));
  return sum;
}

/// Fills `passed` where the answer is known and clears `unknown` there.
void recall(const ShadowAnswer& answer, int n, uint8_t* unknown, TmVec3 passed) {
  if (answer.passed.size() != static_cast<size_t>(n)) return;
  auto part = answer.parts.begin();
  for (int i = 0; i < n; ++i) {
    const uint8_t p = answer.passed[static_cast<size_t>(i)];
    if (p == ShadowAnswer::Unknown || (p == ShadowAnswer::Part && part == answer.parts.end())) continue;
    set(passed, i, p == ShadowAnswer::Everything ? vec3(1.0f) : p == ShadowAnswer::Part ? *part++ : vec3(0.0f));
    unknown[i] = 0;
  }
}

ShadowAnswer answerOf(TmVec3 passed, const uint8_t* traced, int n, uint64_t asked) {
  ShadowAnswer answer{asked, {}, {}};
  for (int i = 0; i < n; ++i) {
    const vec3 p = get(passed, i);
    const bool part = p != vec3(0.0f) && p != vec3(1.0f);
    answer.passed.push_back(!traced[i]       ? ShadowAnswer::Unknown
                            : part           ? ShadowAnswer::Part
                            : p == vec3(1.0f) ? ShadowAnswer::Everything
                                              : ShadowAnswer::Nothing);
    if (traced[i] && part) answer.parts.push_back(p);
  }
  return answer;
}

}  // namespace

void Lights::restrictTo(const std::string* group) { group_ = group; }

void Lights::ambient(Batch& batch, const TmGrid& asking, TmVec3 out) {
  for (int i = 0; i < asking.count; ++i)
    if (asking.active[i]) set(out, i, vec3(0.0f));
  for (const BoundLight* light : batch.group.lights) {
    if (!light->can(TM_LIGHT_AMBIENT) || !applies(*light, batch) || (group_ && light->group != *group_)) continue;
    const TmGrid g = lightGrid(batch, *light);
    if (!batch.run(*light->bound, g)) continue;
    for (int i = 0; i < g.count; ++i)
      if (asking.active[i]) set(out, i, get(out, i) + get(g.Cl, i));
  }
}

std::vector<LightSample>& Lights::samples(Batch& batch) {
  if (!evaluated_) {
    evaluated_ = true;
    if (batch.points && batch.context.light != Illumination::Lights) substitute(batch);
    for (const BoundLight* light : batch.group.lights)
      if (!light->can(TM_LIGHT_AMBIENT) && applies(*light, batch)) evaluate(batch, *light);
  }
  if (!group_) return samples_;
  // Copies share the arrays: what has been traced for one is traced for all.
  chosen_.clear();
  for (const LightSample& s : samples_)
    if (s.light->group == *group_) chosen_.push_back(s);
  return chosen_;
}

/// One light along the normal in place of all.
void Lights::substitute(Batch& batch) {
  if (batch.context.light == Illumination::None) return;
  const TmVec3 L = batch.arena.vec3(batch.tm.count), Cl = batch.arena.vec3(batch.tm.count);
  for (int i = 0; i < batch.points->count(); ++i) {
    set(L, i, batch.points->facingNormal(i));
    set(Cl, i, vec3(batch.context.light == Illumination::Unit ? 1.0f : 0.0f));
  }
  if (batch.context.light == Illumination::Stored && batch.scene.services)
    batch.scene.services->storedIrradiance(*batch.points, batch.tm.active, Cl);
  samples_.push_back({&batch.scene.stored, L, Cl, L, {}, nullptr, L});
}

void Lights::evaluate(Batch& batch, const BoundLight& light) {
  const bool area = light.can(TM_LIGHT_AREA);
  const bool sampled = area || light.can(TM_LIGHT_SAMPLED);
  const int n = sampled && batch.context.lightSamples > 0 ? batch.context.lightSamples : light.samples;
  float* emitterArea = batch.arena.floats(batch.points->count());
  for (int s = 0; s < n; ++s) {
    TmGrid g = lightGrid(batch, light);
    openOutputs(batch, *light.bound, params_.emplace_back(light.bound->values));
    g.params = params_.back().data();
    g.sample = s, g.samples = n;
    if (sampled) drawSample(batch, light, g);
    if (area && !sampleEmitter(batch, light, g, emitterArea)) return;
    if (!batch.run(*light.bound, g)) return;
    darkenNonFinite(batch, *light.bound, g);
    if (area) radianceToSample(g, emitterArea);
    LightSample sample{&light, batch.arena.vec3(batch.tm.count), g.Cl, g.L, {light.can(TM_LIGHT_SOLAR), s, n}, nullptr, g.L, g.params};
    if (const int k = light.bound->output("__nondiffuse", ValueType::Float); k >= 0) sample.nondiffuse = g.params[k].c[0];
    if (const int k = light.bound->output("__nonspecular", ValueType::Float); k >= 0) sample.nonspecular = g.params[k].c[0];
    for (int i = 0; i < g.count; ++i) set(sample.L, i, normalizeOr(get(g.L, i), vec3(0.0f)));
    if (light.shadows && batch.scene.services) {
      if (area) sample.toward = beforeEmitter(batch, g, batch.scene.services->emitterReach(light.index));
      sample.pending = batch.arena.bytes(g.count);
      std::copy_n(g.active, g.count, sample.pending);
    }
    samples_.push_back(sample);
  }
}

void Lights::shadow(Batch& batch, LightSample& sample, const uint8_t* want) const {
  if (!sample.pending) return;
  const int n = batch.points->count();
  uint8_t* trace = batch.arena.bytes(n);
  bool any = false;
  for (int i = 0; i < n; ++i) {
    trace[i] = want[i] && sample.pending[i] && get(sample.Cl, i) != vec3(0.0f);
    if (!trace[i]) continue;
    sample.pending[i] = 0, any = true;
  }
  if (any && batch.context.answers)
    shadowFromAnswers(batch, sample, trace);
  else if (any)
    batch.scene.services->transmission(*batch.points, trace, view(sample.toward), sample.rays, batch.context, sample.Cl);
}

// What no answer is known of is traced. When answers are being recorded that is every point, wherever the shader looks and
// however bright the light: intensities, cones and surfaces may then change without a ray.
void Lights::shadowFromAnswers(Batch& batch, LightSample& sample, const uint8_t* want) const {
  RayAnswers& answers = *batch.context.answers;
  const int n = batch.points->count();
  const uint64_t asked = sumOf(view(sample.toward), n, sample.rays);
  const ShadowQuestion question{batch.context.chunk, sample.light->index, sample.rays.sample};
  const TmVec3 passed = batch.arena.vec3(n);
  uint8_t* unknown = batch.arena.bytes(n);
  std::copy_n(answers.recording ? batch.tm.active : want, n, unknown);
  const auto known = answers.shadows.find(question);
  if (known != answers.shadows.end() && known->second.asked == asked)
    recall(known->second, n, unknown, passed);
  if (std::any_of(unknown, unknown + n, [](uint8_t u) { return u != 0; })) {
    for (int i = 0; i < n; ++i)
      if (unknown[i]) set(passed, i, vec3(1.0f));
    batch.scene.services->transmission(*batch.points, unknown, view(sample.toward), sample.rays, batch.context, passed);
    if (answers.recording) answers.shadows[question] = answerOf(passed, unknown, n, asked);
  }
  for (int i = 0; i < n; ++i)
    if (want[i]) set(sample.Cl, i, get(sample.Cl, i) * get(passed, i));
}

}  // namespace tomales

#include "reyes/shade/lights.h"

#include <fmt/format.h>

#include "reyes/rsl_host.h"
#include "reyes/shade/batch.h"
#include "reyes/shade/illuminate.h"
#include "reyes/shade/light_runs.h"
#include "reyes/shade/light_services.h"
#include "reyes/shade/parameter_values.h"
#include "reyes/shade/primary.h"

namespace tomales {
namespace {

/// Tells whether the context lets the light shine. A direct light that it leaves out still counts where numbers of
/// samples are chosen, so that the pictures of single lights add up.
bool shines(const BoundLight& light, const Batch& batch) {
  return light.can(TM_LIGHT_INDIRECT) || isMeant(light, batch.context);
}

/// Draws random numbers of sample number g.sample.
void drawSample(Batch& batch, const BoundLight& light, TmGrid& g) {
  float* xi0 = batch.arena.floats(g.count);
  float* xi1 = batch.arena.floats(g.count);
  for (int i = 0; i < g.count; ++i) {
    const vec2 xi = sampleAt(batch, light, i, g.sample, g.samples);
    xi0[i] = xi.x;
    xi1[i] = xi.y;
  }
  g.xi0 = xi0;
  g.xi1 = xi1;
}

}  // namespace

void Lights::restrictTo(const std::string* group) { group_ = group; }

void Lights::multiplySamples(int64_t times) {
  if (!evaluated_) times_ = static_cast<int>(std::clamp<int64_t>(times, 1, kMostLightSamples));
}

const LightSets* Lights::setsOf(const Batch& batch) const {
  return group_ || batch.context.onlyLightGroup || !batch.points ? nullptr : batch.group.choice->sets(batch.scene);
}

const LightList& Lights::alone(const Batch& batch) const {
  const LightSets* sets = setsOf(batch);
  return sets ? sets->alone : batch.group.lights();
}

void Lights::ambient(Batch& batch, const TmGrid& asking, TmVec3 out) {
  ambientAsked_ = true;
  for (int i = 0; i < asking.count; ++i)
    if (asking.active[i]) set(out, i, vec3(0.0f));
  for (const int index : alone(batch)) {
    const BoundLight& light = batch.scene.light(index);
    if (!light.can(TM_LIGHT_AMBIENT) || !applies(light, batch) || !shines(light, batch) ||
        (group_ && light.group != *group_))
      continue;
    const TmGrid g = lightGrid(batch, light);
    if (!batch.run(*light.bound, g)) continue;
    for (int i = 0; i < g.count; ++i)
      if (asking.active[i]) set(out, i, get(out, i) + get(g.Cl, i));
  }
}

std::vector<LightSample>& Lights::samples(Batch& batch, bool indirect) {
  if (!evaluated_ && batch.points && batch.context.illumination != Illumination::Lights) substitute(batch);
  const bool runsDirect = !evaluated_, runsIndirect = indirect && !indirectEvaluated_;
  evaluated_ = true;
  indirectEvaluated_ |= indirect;
  const LightSets* sets = setsOf(batch);
  for (const int index : alone(batch))
    if (const BoundLight& light = batch.scene.light(index);
        (light.can(TM_LIGHT_INDIRECT) ? runsIndirect : runsDirect) && !light.can(TM_LIGHT_AMBIENT) &&
        applies(light, batch) && shines(light, batch) && (!request_ || inCategory(light.category, request_->category)))
      evaluate(batch, light);
  for (size_t k = 0; sets && runsDirect && k < sets->sets.size(); ++k)
    if (const BoundLight& first = *sets->sets[k].set->lights[0];
        applies(first, batch) && (!request_ || inCategory(first.category, request_->category)))
      evaluateDrawn(batch, sets->sets[k]);
  if (!group_) return samples_;
  // Copies of a sample share its arrays, so shadow rays that are traced for one copy count for all.
  chosen_.clear();
  for (const LightSample& s : samples_)
    if (s.light->group == *group_) chosen_.push_back(s);
  return chosen_;
}

/// Adds stored or unit light, as one light along the normal, in place of all lights or beside them.
void Lights::substitute(Batch& batch) {
  if (batch.context.illumination == Illumination::None || batch.points->inAir())
    return;  // stored light is that of surfaces
  const TmVec3 L = batch.arena.vec3(batch.tm.count), Cl = batch.arena.vec3(batch.tm.count);
  for (int i = 0; i < batch.points->count(); ++i) {
    set(L, i, batch.points->facingNormal(i));
    set(Cl, i, vec3(batch.context.illumination == Illumination::Unit ? 1.0f : 0.0f));
  }
  if (bringsStored(batch.context.illumination) && batch.scene.services)
    batch.scene.services->storedIrradiance(*batch.points, batch.tm.active, Cl);
  samples_.push_back({.light = &batch.scene.stored, .L = L, .Cl = Cl, .toward = L, .far = L});
}

void Lights::tell(Batch& batch, const BoundShader& light, std::vector<TmValue>& params) const {
  if (!request_) return;
  std::vector<std::string> unfit;  // one message names them all
  for (const LightMessage& m : request_->sent)
    for (size_t k = 0; k < static_cast<size_t>(light.shader->paramCount); ++k) {
      const TmParamDecl& decl = light.shader->params[k];
      if (decl.name != m.name || isOutput(decl)) continue;
      const bool fits = floatsOf(typeOf(decl)) == floatsOf(m.type) && decl.arrayLength == 1 &&
                        (m.value.step == 0 || !isUniform(decl));
      if (!fits)
        unfit.push_back(fmt::format("\"{}\"", m.name));
      else {
        params[k] = m.value;
        params[k].string = m.type == TM_STRING ? m.text.c_str() : nullptr;
      }
    }
  if (!unfit.empty())
    batch.report(Severity::Warning, "shader-sends",
                 fmt::format("sends lights {} of another type than \"{}\" has; it keeps its own",
                             fmt::join(unfit, " and "), light.shader->name));
}

void Lights::evaluate(Batch& batch, const BoundLight& light) {
  const bool area = light.can(TM_LIGHT_AREA), sky = light.can(TM_LIGHT_SKY);
  const int n = samplesOf(light, batch);
  ShadowTally* tally = nullptr;
  if (light.shadowVariance > 0 && n > 1 && !request_)  // else it would depend on other points' rays
    tally = &tallies_.emplace_back(
        ShadowTally{batch.arena.floats(batch.points->count()), batch.arena.vec3(batch.points->count())});
  for (int s = 0; s < n; ++s) {
    TmGrid g = lightGrid(batch, light);
    openOutputs(batch, *light.bound, params_.emplace_back(light.bound->values));
    tell(batch, *light.bound, params_.back());
    g.params = params_.back().data();
    g.sample = s;
    g.samples = n;
    EmitterPoints points{};
    if (area || sky || light.can(TM_LIGHT_SAMPLED)) drawSample(batch, light, g);
    if (area || sky) points = emitterPoints(batch, light, g);
    if (area && !sampleEmitter(batch, light, g, points)) return;
    if (sky) sampleSky(batch, light, g, points);
    if (!runWithExtent(batch, light, g)) return;
    const bool allRound = area && light.allRound;
    if (isMean(*light.bound->shader) && !allRound) meanToRadiance(g, batch.scene.services, light);
    darkenNonFinite(batch, *light.bound, g);
    if (area || sky) {
      for (int i = 0; i < g.count; ++i) {
        points.pdf[i] *= static_cast<float>(n);
        points.meetPdf[i] *= static_cast<float>(n);
      }
      radianceToSample(g, points.pdf);
    }
    LightSample sample = sampleOf(batch, light, g, {light.can(TM_LIGHT_SOLAR), s, n}, s);
    sample.pdf = points.meetPdf;
    sample.tally = tally;
    if (allRound) sample.rays.through = light.index;
    if (light.shadows && batch.scene.services) {
      if (area && !allRound) sample.toward = beforeEmitter(batch, g, batch.scene.services->emitterReach(light.index));
      sample.pending = batch.arena.bytes(g.count);
      std::copy_n(g.active, g.count, sample.pending);
    }
    samples_.push_back(sample);
  }
}

template <class Body>
void Lights::forEachWithExtent(Batch& batch, const Body& body) const {
  for (const int index : alone(batch))
    if (const BoundLight& light = batch.scene.light(index);
        hasExtent(light) && !light.nonspecular && applies(light, batch) && (!group_ || light.group == *group_))
      body(light);
}

template <class Body>
void Lights::forEachSetWithExtent(Batch& batch, const Body& body) const {
  const LightSets* sets = setsOf(batch);
  for (size_t k = 0; sets && k < sets->sets.size(); ++k)
    if (const BoundLight& first = *sets->sets[k].set->lights[0];
        hasExtent(first) && !first.nonspecular && applies(first, batch))
      body(sets->sets[k]);
}

int Lights::mostSamples(Batch& batch) const {
  int most = 0;
  forEachWithExtent(batch, [&](const BoundLight& light) { most = std::max(most, samplesOf(light, batch)); });
  forEachSetWithExtent(batch,
                       [&](const LightsOfSet& some) { most = std::max(most, samplesOf(*some.set->lights[0], batch)); });
  return most;
}

void Lights::along(Batch& batch, const LobeDirections& lobe, TmVec3 Cl) {
  forEachWithExtent(batch, [&](const BoundLight& light) {
    if (!shines(light, batch)) return;
    int layer = 0;
    while (alongOne(batch, light, lobe, layer, Cl) && light.allRound) ++layer;
  });
  forEachSetWithExtent(batch, [&](const LightsOfSet& some) { alongDrawn(batch, some, lobe, Cl); });
  ++lobes_;
}

void Lights::addSkies(Batch& batch, TmConstVec3 direction, const uint8_t* leaves, TmConstVec3 opacity,
                      TmVec3 color) const {
  const bool lit = bringsLights(batch.context.illumination) || bringsStored(batch.context.illumination);
  if (!lit || std::none_of(leaves, leaves + batch.points->count(), [](uint8_t l) { return l != 0; })) return;
  for (const int index : alone(batch)) {
    const BoundLight& light = batch.scene.light(index);
    if (!light.can(TM_LIGHT_SKY) || !light.visible || light.nonspecular || !isOn(light, batch) ||
        !shines(light, batch) || (group_ && light.group != *group_))
      continue;
    TmGrid g = lightGrid(batch, light);
    g.active = leaves;
    for (int i = 0; i < g.count; ++i) set(g.L, i, get(direction, i));
    if (!batch.run(*light.bound, g)) continue;
    darkenNonFinite(batch, *light.bound, g);
    forActive(&g, [&](int i) { set(color, i, get(color, i) + (1.0f - get(opacity, i)) * get(g.Cl, i)); });
  }
}

bool Lights::alongOne(Batch& batch, const BoundLight& light, const LobeDirections& lobe, int layer, TmVec3 Cl) {
  TmGrid g = lightGrid(batch, light);
  g.sample = lobe.sample;
  g.samples = lobe.samples;
  const EmitterPoints points = emitterPoints(batch, light, g);
  if (!meetLight(batch, light, g, lobe, layer, points)) return false;
  uint8_t* met = batch.arena.bytes(g.count);
  for (int i = 0; i < g.count; ++i) met[i] = g.active[i] && lobe.pdf[i] > 0 && points.pdf[i] > 0;
  if (std::none_of(met, met + g.count, [](uint8_t m) { return m != 0; })) return false;
  g.active = met;
  if (!runWithExtent(batch, light, g)) return false;
  if (isMean(*light.bound->shader)) meanToRadiance(g, batch.scene.services, light);
  const auto own = static_cast<float>(samplesOf(light, batch)), drawn = static_cast<float>(lobe.samples);
  for (int i = 0; i < g.count; ++i) {
    if (!met[i]) continue;
    const float a = own * points.pdf[i], b = drawn * lobe.pdf[i];
    points.pdf[i] = (a * a + b * b) / b;  // b over its weight by the power heuristic
  }
  const float reach = light.can(TM_LIGHT_AREA) ? batch.scene.services->emitterReach(light.index) : 0;
  const bool before = reach != 0 && !light.allRound;
  addMet(batch, light, g, before ? beforeEmitter(batch, g, reach) : g.L, points.pdf, lobe, layer, Cl);
  return true;
}

void Lights::addMet(Batch& batch, const BoundLight& light, const TmGrid& g, TmVec3 toward, const float* pdf,
                    const LobeDirections& lobe, int layer, TmVec3 Cl) {
  constexpr int kMostLobes = 1 << 20;
  radianceToSample(g, pdf);
  // The light's own samples have question numbers below the limit of their number.
  LightSample sample{&light,
                     g.L,
                     g.Cl,
                     toward,
                     {light.can(TM_LIGHT_SOLAR), lobe.sample, lobe.samples},
                     nullptr,
                     kMostLightSamples + lobes_ + layer * kMostLobes};
  if (light.allRound) sample.rays.through = light.index;
  if (light.shadows && batch.scene.services) {
    sample.pending = batch.arena.bytes(g.count);
    std::copy_n(g.active, g.count, sample.pending);
    shadow(batch, sample, g.active);
  }
  for (int i = 0; i < g.count; ++i)
    if (g.active[i]) set(Cl, i, get(Cl, i) + get(g.Cl, i));
}

}  // namespace tomales

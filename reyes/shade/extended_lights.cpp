#include "reyes/shade/extended_lights.h"

#include "reyes/rsl_host.h"
#include "reyes/shade/batch.h"

namespace tomales {

namespace {

/// The number of samples that a sample of a sky counts as in the power heuristic. A sky's samples are spread over the
/// hemisphere, so few of them fall into a lobe, and the lobe's own samples know more about it than the same number of
/// samples of the sky.
constexpr float kWorthOfSkySample = 0.25f;

}  // namespace

bool hasExtent(const BoundLight& light) { return light.can(TM_LIGHT_AREA) || light.can(TM_LIGHT_SKY); }

EmitterPoints emitterPoints(Batch& batch, const BoundLight& light, TmGrid& g) {
  const int n = g.count;
  const int all = batch.tm.count;  // lightsource() may ask at neighbours
  const EmitterPoints points{batch.arena.vec3(all), batch.arena.vec3(all), batch.arena.floats(n),
                             batch.arena.floats(n)};
  if (light.can(TM_LIGHT_AREA)) {
    g.Pl = view(points.P);
    g.Nl = view(points.N);
  }
  return points;
}

bool sampleEmitter(Batch& batch, const BoundLight& light, TmGrid& g, const EmitterPoints& points) {
  const ShadeServices* services = batch.scene.services;
  if (!services) return false;
  if (light.allRound ? !services->sampleWholeEmitter(light.index, g.count, view(g.P), g.xi0, g.xi1, points)
                     : !services->sampleEmitter(light.index, g.count, view(g.P), g.xi0, g.xi1, points))
    return false;
  for (int i = 0; i < g.count; ++i) set(g.L, i, get(g.Pl, i) - get(g.P, i));
  return true;
}

void sampleSky(Batch& batch, const BoundLight& light, TmGrid& g, const EmitterPoints& points) {
  for (int i = 0; i < g.count; ++i) {
    set(g.L, i, light.sky->sample(get(g.P, i), batch.points->facingNormal(i), {g.xi0[i], g.xi1[i]}, points.pdf[i]));
    points.meetPdf[i] = kWorthOfSkySample * points.pdf[i];
  }
}

bool runWithExtent(Batch& batch, const BoundLight& light, TmGrid& g) {
  const TmVec3 asked = g.L;
  if (light.can(TM_LIGHT_SKY)) {
    g.L = batch.arena.vec3(batch.tm.count);
    for (int i = 0; i < g.count; ++i) set(g.L, i, get(asked, i));
  }
  const bool ran = batch.run(*light.bound, g);
  g.L = asked;
  return ran;
}

bool meetLight(Batch& batch, const BoundLight& light, TmGrid& g, const LobeDirections& lobe, int layer,
               const EmitterPoints& points) {
  for (int i = 0; i < g.count; ++i) set(g.L, i, get(lobe.L, i));
  if (light.can(TM_LIGHT_AREA)) {
    const ShadeServices* services = batch.scene.services;
    if (!services) return false;
    if (light.allRound)
      services->meetWholeEmitter(light.index, layer, g.count, view(g.P), lobe.L, points);
    else
      services->meetEmitter(light.index, g.count, view(g.P), lobe.L, points);
    for (int i = 0; i < g.count; ++i)
      if (points.pdf[i] > 0) set(g.L, i, get(g.Pl, i) - get(g.P, i));
    return true;
  }
  for (int i = 0; i < g.count; ++i)
    points.pdf[i] = kWorthOfSkySample * light.sky->pdf(get(g.P, i), batch.points->facingNormal(i), get(g.L, i));
  return true;
}

TmVec3 beforeEmitter(Batch& batch, const TmGrid& g, float reach) {
  if (reach == 0) return g.L;
  const TmVec3 toward = batch.arena.vec3(g.count);
  for (int i = 0; i < g.count; ++i) set(toward, i, get(g.L, i) + reach * get(g.Nl, i));
  return toward;
}

void radianceToSample(const TmGrid& g, const float* pdf) {
  for (int i = 0; i < g.count; ++i) {
    const float weight = pdf[i] > 0 ? 1 / (kPi * pdf[i]) : 0.0f;
    set(g.Cl, i, weight > 0 ? get(g.Cl, i) * weight : vec3(0.0f));
  }
}

void meanToRadiance(const TmGrid& g, const ShadeServices* services, const BoundLight& light) {
  const float area = services ? services->emitterArea(light.index) : 0.0f;
  const bool allRound = light.allRound;
  for (int i = 0; i < g.count; ++i) {
    const vec3 L = get(g.L, i), N = get(g.Nl, i);
    const float distance2 = dot(L, L), facing = -dot(L, N) / std::sqrt(distance2),
                cosine = allRound ? std::abs(facing) : facing;
    set(g.Cl, i, area > 0 && cosine > 0 ? get(g.Cl, i) * (kPi * distance2 / (cosine * area)) : vec3(0.0f));
  }
}

}  // namespace tomales

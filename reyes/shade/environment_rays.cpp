#include "reyes/shade/environment_rays.h"

#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/shade/picture_services.h"
#include "reyes/shade/ray_services.h"
#include "reyes/shade/ray_shots.h"
#include "reyes/shade/spaces.h"

namespace tomales {
namespace {

constexpr uint32_t kEnvironmentStream = randomStream("envi");

vec2 randomOf(const Batch& batch, int i, int ray, int samples) {
  const SampleName name = batch.points->name(i);
  return sobol2(name.sequence * static_cast<uint32_t>(samples) + static_cast<uint32_t>(ray),
                hashCombine(name.key, kEnvironmentStream, batch.context.seed));
}

}  // namespace

int32_t gatherEnvironment(Batch& batch, const TmGrid* all, TmConstVec3 P, const TmRayOptions& options, int32_t ray,
                          uint8_t* hit, const TmChannel* outputs, int32_t outputCount) {
  if (!batch.points || ray < 0 || ray >= options.samples) return 0;
  const Primary primary(batch, all);
  const TmGrid* g = primary.grid();
  const mat3 currentFromMap = glm::inverse(environmentDirections(batch, options.environmentSpace));
  const Sky& sky = batch.scene.skies.find(options.environment, batch.running->where, batch.running->user);
  const TmVec3 direction = batch.arena.vec3(g->count), along = batch.arena.vec3(g->count),
               color = batch.arena.vec3(g->count);
  float *solidAngle = batch.arena.floats(g->count), *width = batch.arena.floats(g->count),
        *far = batch.arena.floats(g->count);
  forActive(g, [&](int i) {
    float pdf = 0;
    const vec3 L = sky.sample(vec3(0.0f), vec3(0.0f), randomOf(batch, i, ray, options.samples), pdf);
    set(along, i, L);
    set(direction, i, normalizeOr(currentFromMap * L, L));
    solidAngle[i] = 1 / (pdf * static_cast<float>(options.samples));
    width[i] = kSkyCell;
    far[i] = kRiInfinity;
    hit[i] = 0;
  });
  TmTextureOptions lookup = tmTextureDefaults();
  lookup.angle = width;
  environment(&batch, g, options.environment, &lookup, view(along), color);
  primary.spread(hit);
  setRayOutputs(primary, outputs, outputCount,
                {{"environment:color", view(color)},
                 {"environment:direction", view(direction)},
                 {"environment:solidangle", {solidAngle, solidAngle, solidAngle}},
                 {"ray:origin", P},
                 {"ray:direction", view(direction)},
                 {"ray:length", {far, far, far}},
                 {"effectivedistance", {far, far, far}}});
  return 1;
}

}  // namespace tomales

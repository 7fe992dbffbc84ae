#include "reyes/shade/cloud_services.h"

#include <fmt/format.h>

#include <span>

#include "reyes/shade/footprint.h"
#include "reyes/shade/primary.h"
#include "reyes/shade/spaces.h"

namespace tomales {
namespace {

TmCloudLookup optionsOf(const TmCloudLookup* given) { return givenOptions<TmCloudLookup>(TM_CLOUD_DEFAULTS, given); }

std::vector<CloudValue> valuesOf(const TmCloudValue* values, int32_t count) {
  std::vector<CloudValue> out;
  for (const TmCloudValue& v : std::span(values, static_cast<size_t>(std::max(0, count))))
    out.push_back({v.name, v.floats == 3 ? 3 : 1, {v.c[0], v.c[1], v.c[2]}});
  return out;
}

bool refuse(const Batch& batch, const char* file, const std::string& problem) {
  batch.report(Severity::Missing, fmt::format("cloud-{}", file).c_str(),
               fmt::format("point cloud \"{}\": {}", file, problem));
  return false;
}

/// Of lengths.
float scaleOf(const mat4& m) { return std::cbrt(std::abs(glm::determinant(mat3(m)))); }

/// Points and their radii in the space of the file. False: there is none of that name, which has been reported.
bool toFile(Batch& batch, const TmGrid* g, const char* file, TmConstVec3 P, TmConstVec3 N, const TmCloudLookup& options,
            CloudQuery& query) {
  const char* name = options.coordSystem ? options.coordSystem : "world";
  const std::optional<Space> space = findSpace(batch, name);
  if (!space || space->kind != Space::Linear)
    return refuse(batch, file, fmt::format("there is no coordinate system \"{}\"", name));
  const mat4 fileFromCurrent = glm::inverse(space->currentFromSpace);
  const float scale = scaleOf(fileFromCurrent) * options.radiusScale;
  const TmVec3 p = batch.arena.vec3(g->count), n = batch.arena.vec3(g->count);
  float* radius = batch.arena.floats(g->count);
  forActive(g, [&](int i) {
    set(p, i, transformPoint(fileFromCurrent, get(P, i)));
    set(n, i, N.x ? normalizeOr(transformAs(TM_NORMAL, fileFromCurrent, get(N, i)), vec3(0)) : vec3(0));
    radius[i] = scale * (options.radius ? options.radius[i]
                         : batch.points ? micropolygonRadius(*batch.points, g, i)
                                        : 0.0f);
  });
  query.file = file, query.count = g->count, query.active = g->active;
  query.P = view(p), query.N = view(n), query.radius = radius;
  return true;
}

}  // namespace

// Each point once: not for the neighbours that serve derivatives, for what rays meet, or where a shader runs again for
// a light group.
int32_t bake3d(void* host, const TmGrid* all, const char* file, TmConstVec3 P, TmConstVec3 N,
               const TmCloudLookup* given, const TmCloudValue* values, int32_t valueCount) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  if (!batch.points || batch.context.kind != RayKind::Camera || batch.context.rehearsal || batch.context.sketch ||
      batch.lights.restricted())
    return 1;
  if (!batch.scene.clouds) return refuse(batch, file, "nothing is baked here");
  CloudQuery query;
  if (!toFile(batch, primary.grid(), file, P, N, optionsOf(given), query)) return 0;
  std::string problem;
  return batch.scene.clouds->bake(query, valuesOf(values, valueCount), problem) || refuse(batch, file, problem);
}

int32_t texture3d(void* host, const TmGrid* all, const char* file, TmConstVec3 P, TmConstVec3 N,
                  const TmCloudLookup* given, const TmCloudValue* values, int32_t valueCount, float* found) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  forActive(all, [&](int i) { found[i] = 0; });
  if (!batch.scene.clouds) return refuse(batch, file, "nothing is looked up here");
  CloudQuery query;
  if (!toFile(batch, primary.grid(), file, P, N, optionsOf(given), query)) return 0;
  std::string problem;
  const bool isKnown = batch.scene.clouds->lookUp(query, valuesOf(values, valueCount), found, problem);
  primary.spread(found);
  for (const TmCloudValue& v : std::span(values, static_cast<size_t>(std::max(0, valueCount))))
    for (int k = 0; k < (v.floats == 3 ? 3 : 1); ++k) primary.spread(v.c[k]);
  return isKnown || refuse(batch, file, problem);
}

int32_t photonMap(void* host, const TmGrid* all, const char* file, TmConstVec3 P, TmConstVec3 N, int32_t estimator,
                  TmVec3 out) {
  TmPhotonLookup options = TM_PHOTON_DEFAULTS;
  options.estimator = estimator;
  return photonMapWith(host, all, file, P, N, &options, out);
}

int32_t photonMapWith(void* host, const TmGrid* all, const char* file, TmConstVec3 P, TmConstVec3 N,
                      const TmPhotonLookup* given, TmVec3 out) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  forActive(all, [&](int i) { set(out, i, vec3(0)); });
  if (!batch.scene.clouds) return refuse(batch, file, "nothing is looked up here");
  CloudQuery query;
  if (!toFile(batch, primary.grid(), file, P, N, TM_CLOUD_DEFAULTS, query)) return 0;
  std::string problem;
  const bool isKnown =
      batch.scene.clouds->photons(query, givenOptions<TmPhotonLookup>(TM_PHOTON_DEFAULTS, given), out, problem);
  primary.spread(out);
  return isKnown || refuse(batch, file, problem);
}

bool occlusionByDisks(Batch& batch, const TmGrid* g, const char* file, TmConstVec3 P, TmConstVec3 N,
                      const DisksQuery& disks, float* covered, TmVec3 radiance) {
  if (!batch.scene.clouds) return refuse(batch, file, "nothing is looked up here");
  CloudQuery query;
  if (!toFile(batch, g, file, P, N, TM_CLOUD_DEFAULTS, query)) return false;
  DisksQuery inFile = disks;
  const float scale = 1 / scaleOf(batch.scene.cameraFromWorld);
  OcclusionQuery& far = inFile.falloff;
  if (far.maxDistance < 1e30f) far.maxDistance *= scale;
  if (far.bias > 0) far.bias *= scale;
  if (far.falloffMode != 1) far.falloff /= scale;
  std::string problem;
  return batch.scene.clouds->occlusion(query, inFile, covered, radiance, problem) || refuse(batch, file, problem);
}

int32_t subsurface(void* host, const TmGrid* all, const char* file, TmConstVec3 P, const TmSubsurface* given,
                   TmVec3 out) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  forActive(all, [&](int i) { set(out, i, vec3(0)); });
  if (!batch.scene.clouds) return refuse(batch, file, "nothing is looked up here");
  const TmSubsurface material = givenOptions<TmSubsurface>(TM_SUBSURFACE_DEFAULTS, given);
  TmCloudLookup options = TM_CLOUD_DEFAULTS;
  options.coordSystem = material.coordSystem;
  CloudQuery query;
  if (!toFile(batch, primary.grid(), file, P, TmConstVec3{}, options, query)) return 0;
  std::string problem;
  const bool isKnown = batch.scene.clouds->subsurface(query, material, out, problem);
  primary.spread(out);
  return isKnown || refuse(batch, file, problem);
}

}  // namespace tomales

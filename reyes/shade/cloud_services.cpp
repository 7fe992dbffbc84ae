// Point clouds and brick maps behind TmServices.
#include "reyes/shade/cloud_services.h"

#include <fmt/format.h>

#include <span>

#include "reyes/shade/footprint.h"
#include "reyes/shade/primary.h"
#include "reyes/shade/services.h"
#include "reyes/shade/spaces.h"

namespace tomales {
namespace {

std::vector<CloudValue> valuesOf(const TmChannel* values, int32_t count) {
  std::vector<CloudValue> out;
  for (const TmChannel& v : std::span(values, static_cast<size_t>(std::max(0, count))))
    out.push_back({v.name, v.value.y ? 3 : 1, {v.value.x, v.value.y, v.value.z}});
  return out;
}

bool refuse(const Batch& batch, const char* file, const std::string& problem) {
  batch.report(Severity::Missing, "point-cloud", fmt::format("point cloud \"{}\": {}", file, problem), file);
  return false;
}

/// Converts points and their radii to the space of the file. Returns false, after a report, if the space is unknown.
bool toFile(Batch& batch, const TmGrid* g, const char* file, TmConstVec3 P, TmConstVec3 N,
            const TmCloudOptions& options, CloudQuery& query) {
  const char* name = options.coordSystem ? options.coordSystem : "world";
  const std::optional<Space> space = findSpace(batch, name);
  if (!space || space->kind != Space::Linear)
    return refuse(batch, file, fmt::format("there is no coordinate system \"{}\"", name));
  const mat4 fileFromCurrent = glm::inverse(space->currentFromSpace);
  const float scale = lengthScale(fileFromCurrent) * options.radiusScale;
  const TmVec3 p = batch.arena.vec3(g->count), n = batch.arena.vec3(g->count);
  float* radius = batch.arena.floats(g->count);
  forActive(g, [&](int i) {
    set(p, i, transformPoint(fileFromCurrent, get(P, i)));
    set(n, i, N.x ? normalizeOr(transformAs(TM_NORMAL, fileFromCurrent, get(N, i)), vec3(0)) : vec3(0));
    radius[i] = scale * (options.radius ? options.radius[i]
                         : batch.points ? micropolygonRadius(*batch.points, g, i)
                                        : 0.0f);
  });
  query.file = file;
  query.count = g->count;
  query.active = g->active;
  query.P = view(p);
  query.N = view(n);
  query.radius = radius;
  return true;
}

// Bakes each point once: not for the neighbours that serve derivatives, nor for hits of rays, nor where a shader runs
// again for a light group. A scene that gives no file's name wants none baked or read, as with pictures.
int32_t bake3d(void* host, const TmGrid* all, const char* file, const TmCloudOptions* given, TmConstVec3 P,
               TmConstVec3 N, const TmChannel* values, int32_t valueCount) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  if (!*file || !batch.points || batch.context.kind != RayKind::Camera || batch.context.purpose != Purpose::Picture ||
      batch.lights.restricted())
    return 1;
  if (!batch.scene.clouds) return refuse(batch, file, "nothing is baked here");
  CloudQuery query;
  if (!toFile(batch, primary.grid(), file, P, N, givenOptions(batch, tmCloudDefaults(), given), query)) return 0;
  std::string problem;
  return batch.scene.clouds->bake(query, valuesOf(values, valueCount), problem) || refuse(batch, file, problem);
}

int32_t texture3d(void* host, const TmGrid* all, const char* file, const TmCloudOptions* given, TmConstVec3 P,
                  TmConstVec3 N, const TmChannel* values, int32_t valueCount, float* found) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  forActive(all, [&](int i) { found[i] = 0; });
  if (!*file) return 0;
  if (!batch.scene.clouds) return refuse(batch, file, "nothing is looked up here");
  CloudQuery query;
  if (!toFile(batch, primary.grid(), file, P, N, givenOptions(batch, tmCloudDefaults(), given), query)) return 0;
  std::string problem;
  const bool isKnown = batch.scene.clouds->lookUp(query, valuesOf(values, valueCount), found, problem);
  primary.spread(found);
  for (const TmChannel& v : std::span(values, static_cast<size_t>(std::max(0, valueCount)))) primary.spread(v.value);
  return isKnown || refuse(batch, file, problem);
}

int32_t photonMap(void* host, const TmGrid* all, const char* file, const TmPhotonOptions* given, TmConstVec3 P,
                  TmConstVec3 N, TmVec3 out) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  forActive(all, [&](int i) { set(out, i, vec3(0)); });
  if (!batch.scene.clouds) return refuse(batch, file, "nothing is looked up here");
  CloudQuery query;
  if (!toFile(batch, primary.grid(), file, P, N, tmCloudDefaults(), query)) return 0;
  std::string problem;
  const bool isKnown = batch.scene.clouds->photons(query, givenOptions(batch, tmPhotonDefaults(), given), out, problem);
  primary.spread(out);
  return isKnown || refuse(batch, file, problem);
}

int32_t subsurface(void* host, const TmGrid* all, const char* file, const TmSubsurfaceOptions* given, TmConstVec3 P,
                   TmVec3 out) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  forActive(all, [&](int i) { set(out, i, vec3(0)); });
  if (!batch.scene.clouds) return refuse(batch, file, "nothing is looked up here");
  const TmSubsurfaceOptions material = givenOptions(batch, tmSubsurfaceDefaults(), given);
  TmCloudOptions options = tmCloudDefaults();
  options.coordSystem = material.coordSystem;
  CloudQuery query;
  if (!toFile(batch, primary.grid(), file, P, TmConstVec3{}, options, query)) return 0;
  std::string problem;
  const bool isKnown = batch.scene.clouds->subsurface(query, material, out, problem);
  primary.spread(out);
  return isKnown || refuse(batch, file, problem);
}

/// Share of a point's view that large disks may cover before they become visible.
constexpr float kCoarseShare = 0.5f;

/// A single point triggers the warning, so that it does not depend on batches.
void warnOfCoarseDisks(Batch& batch, const TmGrid* g, const char* file, const float* coarse) {
  bool shows = false;
  forActive(g, [&](int i) { shows = shows || coarse[i] > kCoarseShare; });
  if (!shows) return;
  batch.report(Severity::Warning, "point-cloud-coarse",
               fmt::format("point cloud \"{}\": its disks are far larger than the micropolygons beside them, so light "
                           "leaks and shadows are blotchy; bake it with a smaller ShadingRate",
                           file),
               file);
}

}  // namespace

bool occlusionByDisks(Batch& batch, const TmGrid* g, const char* file, TmConstVec3 P, TmConstVec3 N,
                      const DisksQuery& disks, float* covered, TmVec3 radiance) {
  if (!batch.scene.clouds) return refuse(batch, file, "nothing is looked up here");
  CloudQuery query;
  if (!toFile(batch, g, file, P, N, tmCloudDefaults(), query)) return false;
  float *coarse = batch.arena.floats(g->count), *none = batch.arena.floats(g->count);
  std::fill_n(coarse, g->count, 0.0f);
  std::fill_n(none, g->count, 0.0f);
  // Hits of rays lie on the surface itself, and their radius is that of the ray.
  if (batch.context.kind != RayKind::Camera) query.radius = none;
  DisksQuery inFile = disks;
  const float scale = 1 / lengthScale(batch.scene.cameraFromWorld);
  HemisphereQuery& far = inFile.falloff;
  if (far.maxDistance < kRiInfinity) far.maxDistance *= scale;
  if (far.bias > 0) far.bias *= scale;
  if (far.falloffMode != 1) far.falloff /= scale;
  std::string problem;
  if (!batch.scene.clouds->occlusion(query, inFile, covered, radiance, coarse, problem))
    return refuse(batch, file, problem);
  warnOfCoarseDisks(batch, g, file, coarse);
  return true;
}

void addCloudServices(TmServices& services) {
  services.bake3d = bake3d;
  services.texture3d = texture3d;
  services.photonMap = photonMap;
  services.subsurface = subsurface;
}

}  // namespace tomales

// libFuzzer entry: any bytes through the RIB reader, and what comes out of it through freezing, splitting, dicing,
// hiding and tessellation for rays, in a frame of a few pixels. Run as
//   rib_fuzz -max_len=4096 -timeout=20 -rss_limit_mb=4096 WORK_FOLDER tests/corpus/rib tests/corpus/geometry
// with binary seeds from `tomales catrib --binary` in the work folder.
#include <cstddef>
#include <cstdint>

#include "raytrace/trace.h"
#include "reyes/base/parallel.h"
#include "reyes/frame.h"
#include "reyes/rib.h"
#include "reyes/shader_registry.h"

extern const TmShaderLibrary* tomales_builtin_shaders(void);

namespace {
using namespace tomales;

constexpr int kResolution = 12;
constexpr size_t kMostObjects = 16;
constexpr uint32_t kMostPatches = 256;

/// What bounds the work of one run without taking away what makes a scene ugly.
void shrink(Scene& scene) {
  Options& o = scene.options;
  o.xResolution = o.yResolution = kResolution;
  o.xSamples = o.ySamples = 2;
  o.bucketWidth = o.bucketHeight = kResolution;
  o.xFilterWidth = o.yFilterWidth = 1;
  o.gridSize = std::clamp(o.gridSize, 16, 256);
  StableVector<Object> few;
  for (Object& object : scene.objects)
    if (few.size() < kMostObjects && object.shape().patchCount() <= kMostPatches) few.push_back(std::move(object));
  scene.objects = std::move(few);
  for (Object& object : scene.objects) {
    auto a = std::make_shared<Attributes>(*object.attributes);
    a->shadingRate = std::max(a->shadingRate, 4.0f);
    a->trace.tessellation = std::min(a->trace.tessellation, 0.1f);
    a->visibility.diffuse = true;
    object.attributes = std::move(a);
    object.group = -1;
  }
  scene.groups.clear();
  scene.freeze();
}

void goThroughTheStages(Scene scene, Log& log) {
  shrink(scene);
  Stats stats;
  ShaderRegistry registry(log);
  registry.addLibrary(tomales_builtin_shaders(), "built-in");
  ShadingSystem shading(scene, registry, nullptr, log, stats);
  hideFrame(scene, shading, {}, stats, log);
  const RayScene rays(scene, Camera(scene.options), shading, {}, stats, log);
  rays.closest({vec3(0), vec3(0, 0, 1)}, kMaskDiffuse);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const ThreadLimit one(1);
  Log log(Log::Verbosity::Quiet);
  RibSettings settings;
  settings.archivePath.clear();
  settings.onScene = [&log](Scene&& scene) { goThroughTheStages(std::move(scene), log); };
  readRibText({reinterpret_cast<const char*>(data), size}, "fuzz.rib", settings, log);
  return 0;
}

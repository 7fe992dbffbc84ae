#include "reyes/app/frame/overrides.h"

#include <algorithm>

#include "reyes/app/frame/outputs.h"
#include "reyes/scene_changes.h"

namespace tomales {
namespace {

/// Sets the low quality of Tabellion and Lamorlette 2004, section 5.2; other options of the command line override it.
void makeDraft(Scene& scene) {
  constexpr float kCoarser = 16;
  constexpr int kSamples = 2, kRays = 50;
  Options& o = scene.options;
  o.xSamples = std::min(o.xSamples, kSamples);
  o.ySamples = std::min(o.ySamples, kSamples);
  changeAttributes(scene, [](Attributes& a) {
    a.displacement = nullptr;
    a.displacementBound = 0;
    a.shadingRate *= kCoarser;
  });
  o.indirectSamples = kRays;
}

constexpr const char* kTextureMemory = "limits:texturememory";

/// These set an option as if the scene had given it that value.
void setWord(Options& options, const std::string& key, const std::string& value) {
  if (!value.empty()) options.user[key] = wordParam(key.substr(key.find(':') + 1), value);
}
void setNumber(Options& options, const std::string& key, float value) {
  Param& p = options.user[key] = {};
  p.name = key.substr(key.find(':') + 1);
  p.type = ValueType::Float;
  p.floats = {value};
}

/// Raises the limit that a scene may set to 64 MB: the limits of old renderers are too small to be of use.
void raiseTextureMemory(Options& options) {
  constexpr float kLeast_KB = 1 << 16;
  const auto it = options.user.find(kTextureMemory);
  if (it != options.user.end()) it->second.floats = {std::max(kLeast_KB, it->second.number(0))};
}

/// Sets the limit unless the scene asks for less.
void limitTextures(Options& options, int64_t limit_bytes) {
  const float most_KB = static_cast<float>(textureShare(limit_bytes)) / 1024;
  const Param* asked = findParam(options.user, kTextureMemory);
  setNumber(options, kTextureMemory, std::min(asked ? asked->number(most_KB) : most_KB, most_KB));
}

}  // namespace

RaySettings raySettings(const RenderSettings& settings, const Options& options) {
  RaySettings out{settings.light.hitList};
  if (const Param* limit = findParam(options.user, "limits:geocachememory"))
    out.geometryCacheBytes = static_cast<size_t>(std::clamp(limit->number(0), 0.0f, 1e15f) * 1024);
  // Nodes of a cluster may grant different sizes, and must give the same bits.
  if (settings.resources.memoryLimit && !settings.resources.memoryIsGranted)
    out.coarseBytes = static_cast<size_t>(rayShare(*settings.resources.memoryLimit));
  if (settings.resources.geometryCache) out.geometryCacheBytes = static_cast<size_t>(*settings.resources.geometryCache);
  return out;
}

bool tracesFullGeometry(const RenderSettings& settings) {
  return settings.light.fullGeometry.value_or(settings.light.gi && settings.light.gi->fullGeometry);
}

void applyOverrides(Scene& scene, const RenderSettings& settings) {
  raiseTextureMemory(scene.options);
  setWord(scene.options, "shade:specular", settings.picture.specular);
  setWord(scene.options, "shade:arealight", settings.picture.arealight);
  if (settings.resources.textureMemory)
    setNumber(scene.options, kTextureMemory, static_cast<float>(*settings.resources.textureMemory >> 10));
  if (!settings.resources.textureCache.empty())
    scene.options.searchPaths["texturecache"] = settings.resources.textureCache;
  Options& o = scene.options;
  if (settings.resources.memoryLimit) limitTextures(o, *settings.resources.memoryLimit);
  if (!writesMapsAlone(o, settings)) {
    if (settings.picture.format) {
      o.xResolution = (*settings.picture.format)[0];
      o.yResolution = (*settings.picture.format)[1];
    }
    if (settings.picture.crop) o.cropWindow = *settings.picture.crop;
  }
  if (settings.light.gi && settings.light.gi->mode != GiMode::None) o.wantsIndirect = true;
  if (settings.picture.draft) makeDraft(scene);
  if (settings.picture.pixelSamples) {
    o.xSamples = (*settings.picture.pixelSamples)[0];
    o.ySamples = (*settings.picture.pixelSamples)[1];
  }
  if (settings.resources.bucketSize) o.bucketWidth = o.bucketHeight = *settings.resources.bucketSize;
  if (settings.picture.shadingRate)
    changeAttributes(scene, [&](Attributes& a) { a.shadingRate = *settings.picture.shadingRate; });
  if (tracesFullGeometry(settings))
    changeAttributes(scene, [](Attributes& a) {
      a.trace.displacements = true;
      a.trace.rate = TessellationMode::Full;
    });
  if (settings.light.gi && settings.light.gi->mode == GiMode::Reference && scene.options.shutterIsOpen())
    changeAttributes(scene, [](Attributes& a) { a.trace.sampleMotion = true; });
}

}  // namespace tomales

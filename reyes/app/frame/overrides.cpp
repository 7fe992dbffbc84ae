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

}  // namespace

/// Raises the limit that a scene may set to 64 MB: the limits of old renderers are too small to be of use.
void raiseTextureMemory(Options& options) {
  constexpr float kLeast_KB = 1 << 16;
  const auto it = options.user.find("limits:texturememory");
  if (it != options.user.end()) it->second.floats = {std::max(kLeast_KB, it->second.number(0))};
}

/// Sets the limit unless the scene asks for less.
void limitTextures(Options& options, int64_t limit_bytes) {
  Param& p = options.user["limits:texturememory"];
  const float most_KB = static_cast<float>(textureShare(limit_bytes)) / 1024;
  const float asked_KB = p.number(most_KB);
  p = {};
  p.name = "texturememory";
  p.floats = {std::min(asked_KB, most_KB)};
}

RaySettings raySettings(const RenderSettings& settings, const Options& options) {
  RaySettings out{settings.hitList};
  const auto it = options.user.find("limits:geocachememory");
  if (it != options.user.end())
    out.geometryCacheBytes = static_cast<size_t>(std::clamp(it->second.number(0), 0.0f, 1e15f) * 1024);
  // Nodes of a cluster grant different sizes, and give the same bits.
  if (settings.memoryLimit && !settings.memoryIsGranted)
    out.coarseBytes = static_cast<size_t>(rayShare(*settings.memoryLimit));
  if (settings.geometryCache) out.geometryCacheBytes = static_cast<size_t>(*settings.geometryCache);
  return out;
}

bool tracesFullGeometry(const RenderSettings& settings) {
  return settings.fullGeometry.value_or(settings.gi && settings.gi->fullGeometry);
}

/// Sets an option as if the scene had given it that string.
void setWord(Options& options, const std::string& key, const std::string& value) {
  if (value.empty()) return;
  Param p;
  p.name = key.substr(key.find(':') + 1);
  p.type = ValueType::String;
  p.strings = {value};
  options.user[key] = p;
}

void applyOverrides(Scene& scene, const RenderSettings& settings) {
  raiseTextureMemory(scene.options);
  setWord(scene.options, "shade:specular", settings.specular);
  setWord(scene.options, "shade:arealight", settings.arealight);
  if (settings.textureMemory) {
    Param kilobytes;
    kilobytes.name = "texturememory";
    kilobytes.type = ValueType::Float;
    kilobytes.floats = {static_cast<float>(*settings.textureMemory >> 10)};
    scene.options.user["limits:texturememory"] = kilobytes;
  }
  if (!settings.textureCache.empty()) scene.options.searchPaths["texturecache"] = settings.textureCache;
  Options& o = scene.options;
  if (settings.memoryLimit) limitTextures(o, *settings.memoryLimit);
  if (!writesMapsAlone(o, settings)) {
    if (settings.format) {
      o.xResolution = (*settings.format)[0];
      o.yResolution = (*settings.format)[1];
    }
    if (settings.crop) o.cropWindow = *settings.crop;
  }
  if (settings.gi && settings.gi->mode != GiMode::None) o.wantsIndirect = true;
  if (settings.draft) makeDraft(scene);
  if (settings.pixelSamples) {
    o.xSamples = (*settings.pixelSamples)[0];
    o.ySamples = (*settings.pixelSamples)[1];
  }
  if (settings.bucketSize) o.bucketWidth = o.bucketHeight = *settings.bucketSize;
  if (settings.shadingRate) changeAttributes(scene, [&](Attributes& a) { a.shadingRate = *settings.shadingRate; });
  if (tracesFullGeometry(settings))
    changeAttributes(scene, [](Attributes& a) {
      a.trace.displacements = true;
      a.trace.rate = TessellationMode::Full;
    });
  if (settings.gi && settings.gi->mode == GiMode::Reference && scene.shutterIsOpen())
    changeAttributes(scene, [](Attributes& a) { a.trace.sampleMotion = true; });
}

}  // namespace tomales

#include "reyes/app/frame/overrides.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

#include "reyes/base/output_root.h"
#include "reyes/image.h"
#include "reyes/scene_changes.h"

namespace tomales {
namespace {

/// Sets the low quality of approximate-gi 5.2; other options of the command line override it.
void makeDraft(Scene& scene) {
  constexpr float kCoarser = 16;
  constexpr int kSamples = 2, kRays = 50;
  Options& o = scene.options;
  o.xSamples = std::min(o.xSamples, kSamples), o.ySamples = std::min(o.ySamples, kSamples);
  changeAttributes(scene,
                   [](Attributes& a) { a.displacement = nullptr, a.displacementBound = 0, a.shadingRate *= kCoarser; });
  o.indirectSamples = kRays;
}

/// Keeps files that the scene writes below `root`, and where they are read again, but not those that the user named.
void keepBelow(const std::string& root, const std::string& output, Options& options) {
  const bool writesDisplays = output.empty() || namesPicture(output);  // else it is a .dfb or .icf
  const std::string ours = withFrameNumber(output, options.frame);
  for (DisplayCall& d : options.displays)
    if (writesDisplays && d.name != ours) d.name = placeBelow(root, d.name);
  std::string& textures = options.searchPaths["texture"];
  textures = root + ":" + textures;
  std::string& converted = options.searchPaths["texturecache"];
  if (!converted.empty()) converted = placeBelow(root, converted);
}

/// -o replaces the first Display that is no map for later frames; a frame of such maps alone keeps them all. A picture
/// to be looked at has no alpha, and is sRGB unless the scene's Exposure encodes already.
void overrideOutput(Options& options, const std::string& output, bool onePicture) {
  const auto first = std::find_if_not(options.displays.begin(), options.displays.end(), writesMap);
  if (first == options.displays.end()) return;
  if (onePicture)
    options.displays.erase(std::remove_if(first + 1, options.displays.end(), std::not_fn(writesMap)),
                           options.displays.end());
  DisplayCall& display = *first;
  display.name = withFrameNumber(output, options.frame);
  display.type = "file";
  if (!isForScreens(output)) return;
  display.mode = "rgb";
  if (options.exposureGamma == 1 && !findParam(display.params, "transfer")) {
    Param transfer;
    transfer.name = "transfer", transfer.type = ValueType::String, transfer.strings = {"sRGB"};
    display.params.push_back(std::move(transfer));
  }
}

}  // namespace

void dropDisplays(Options& options, const PluginTrust& trust, Log& log) {
  const auto isWindow = [&](const DisplayCall& d) {
    if (!driverOf(d, options, trust).empty()) return false;
    return d.type == "framebuffer" || d.type == "it" || d.type == "windows" || d.type == "x11";
  };
  const bool someFile =
      std::any_of(options.displays.begin(), options.displays.end(), [&](const DisplayCall& d) { return !isWindow(d); });
  std::set<std::string> files;
  std::erase_if(options.displays, [&](const DisplayCall& d) {
    if (someFile && isWindow(d)) {
      log.report(Severity::Note, "display-window", d.where,
                 "Display \"" + d.name + "\" of type " + d.type + ": there are no windows; left out beside the file");
      return true;
    }
    const std::string path = std::filesystem::path(d.name).lexically_normal().string();
    const bool isPicture = namesPicture(path) && driverOf(d, options, trust).empty();
    if (files.insert(isPicture ? path : path + " " + d.type).second) return false;
    log.report(Severity::Warning, "display-twice", d.where,
               "Display \"" + d.name + "\" would write over an earlier Display of this frame; left out");
    return true;
  });
}

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
  p.name = "texturememory", p.floats = {std::min(asked_KB, most_KB)};
}

RaySettings raySettings(const RenderSettings& settings, const Options& options) {
  RaySettings out{settings.hitList};
  const auto it = options.user.find("limits:geocachememory");
  if (it != options.user.end())
    out.geometryCacheBytes = static_cast<size_t>(std::clamp(it->second.number(0), 0.0f, 1e15f) * 1024);
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
  p.name = key.substr(key.find(':') + 1), p.type = ValueType::String, p.strings = {value};
  options.user[key] = p;
}

void applyOverrides(Scene& scene, const RenderSettings& settings) {
  raiseTextureMemory(scene.options);
  setWord(scene.options, "shade:specular", settings.specular);
  setWord(scene.options, "shade:arealight", settings.arealight);
  if (settings.textureMemory) {
    Param kilobytes;
    kilobytes.name = "texturememory", kilobytes.type = ValueType::Float;
    kilobytes.floats = {static_cast<float>(*settings.textureMemory >> 10)};
    scene.options.user["limits:texturememory"] = kilobytes;
  }
  if (!settings.textureCache.empty()) scene.options.searchPaths["texturecache"] = settings.textureCache;
  Options& o = scene.options;
  if (settings.memoryLimit) limitTextures(o, *settings.memoryLimit);
  if (settings.format) o.xResolution = (*settings.format)[0], o.yResolution = (*settings.format)[1];
  if (settings.crop) o.cropWindow = *settings.crop;
  if (settings.gi && settings.gi->mode != GiMode::None) o.wantsIndirect = true;
  if (settings.draft) makeDraft(scene);
  if (settings.pixelSamples) o.xSamples = (*settings.pixelSamples)[0], o.ySamples = (*settings.pixelSamples)[1];
  if (settings.bucketSize) o.bucketWidth = o.bucketHeight = *settings.bucketSize;
  if (o.displays.empty()) o.displays.emplace_back();
  if (namesPicture(settings.output)) overrideOutput(o, settings.output, settings.onePicture);
  if (!settings.outputRoot.empty()) keepBelow(settings.outputRoot, settings.output, o);
  if (settings.shadingRate) changeAttributes(scene, [&](Attributes& a) { a.shadingRate = *settings.shadingRate; });
  if (tracesFullGeometry(settings))
    changeAttributes(scene, [](Attributes& a) { a.trace.displacements = true, a.trace.rate = TessellationMode::Full; });
  if (settings.gi && settings.gi->mode == GiMode::Reference && scene.shutterIsOpen())
    changeAttributes(scene, [](Attributes& a) { a.trace.sampleMotion = true; });
}

}  // namespace tomales

#include "reyes/app/frame/provenance.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "reyes/app/build_info.h"
#include "reyes/base/file_stamp.h"
#include "reyes/base/search_path.h"
#include "reyes/camera.h"
#include "reyes/image.h"
#include "reyes/pictures.h"
#include "reyes/rsl_host.h"
#include "reyes/state_fields.h"
#include "reyes/world_sum.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr const char *kVersionOf = "tomales:version", *kCommit = "tomales:commit", *kScene = "tomales:scene",
                     *kFrame = "tomales:frame", *kSettings = "tomales:settings", *kAudit = "tomales:audit",
                     *kChosen = "tomales:chosen";

/// Returns the options of the command line that pictures depend on and that no option of the scene keeps, where they
/// are not the defaults.
std::string settingsText(const RenderSettings& s) {
  const RenderSettings usual;
  std::string out;
  const auto add = [&](const char* option, const auto& value, const auto& unasked) {
    if (value != unasked) out += fmt::format("{}{} {}", out.empty() ? "" : " ", option, value);
  };
  add("--gi", std::string_view(s.light.gi ? s.light.gi->name : "scene"), std::string_view("scene"));
  add("--samples", s.light.samples, usual.light.samples);
  add("--bounces", s.light.bounces, usual.light.bounces);
  add("--max-error", s.light.maxError, usual.light.maxError);
  add("--error-function", s.light.errorFunction ? static_cast<int>(*s.light.errorFunction) : -1, -1);
  add("--target-error", s.quality.targetError, usual.quality.targetError);
  add("--target-smudges", s.quality.targetSmudges, usual.quality.targetSmudges);
  add("--time-budget", s.quality.timeBudget_s, usual.quality.timeBudget_s);
  add("--light-samples", s.light.lightSamples, usual.light.lightSamples);
  add("--indirect-only", !s.light.direct, false);
  add("--seed", s.picture.seed, usual.picture.seed);
  add("--light-seed", lightSeedOf(s), s.picture.seed);
  add("--photons", s.light.photons, usual.light.photons);
  add("--photon-noise", s.light.photonNoise, usual.light.photonNoise);
  add("--atlas-direct", s.stored.atlasDirect, usual.stored.atlasDirect);
  add("--brick-maxerror", s.stored.brickMaxError, usual.stored.brickMaxError);
  add("--radiosity-texels", s.stored.radiosityTexels, usual.stored.radiosityTexels);
  add("--irradiance-append", s.stored.appendIrradiance, usual.stored.appendIrradiance);
  add("--no-hit-list", !s.light.hitList, false);
  add("--ray-geometry full", s.light.fullGeometry.value_or(false), false);
  if (const auto files = s.input.standardFromFiles)
    add("--standard-shaders", *files ? "files" : "built-in", std::string_view());
  return out;
}

std::string sceneText(const RenderSettings& settings) {
  std::string out;
  for (const std::string& file : settings.input.files)
    out += (out.empty() ? "" : " ") + fs::path(file).filename().string();
  return out;
}

/// Sums size and time of change of all files that the scene's shaders are made of, and of those that they
/// name, by parameters or in their text. Returns nothing if a shader computes the name of a file.
std::optional<uint64_t> shaderSum(const Scene& scene, ShaderRegistry& shaders) {
  const std::string path = pathOf(scene.options.searchPaths, "shader");
  std::set<const ShaderCall*> seen;
  std::vector<ShaderName> names;
  std::set<std::tuple<std::string, TmKind, std::string>> known;  // ten thousand lights may name one shader
  std::set<std::string> files, pictures;
  const auto add = [&](const ShaderCall* call, TmKind kind) {
    if (!call || !seen.insert(call).second) return;
    for (const Param& p : call->params) pictures.insert(p.strings.begin(), p.strings.end());
    std::string beside = call->where.folder().string();
    if (known.emplace(call->name, kind, beside).second) names.push_back({call->name, kind, std::move(beside)});
  };
  for (const auto& light : scene.lights) add(&light->shader, TM_LIGHT);
  if (scene.options.imager) add(&*scene.options.imager, TM_IMAGER);
  for (const ShadeGroup& group : scene.groups) {
    const Attributes& a = *group.attributes;
    add(a.surface.get(), TM_SURFACE);
    add(a.displacement.get(), TM_DISPLACEMENT);
    for (const auto& volume : {a.atmosphere, a.interior, a.exterior}) add(volume.get(), TM_VOLUME);
  }
  shaders.prepare(names, path);
  for (const ShaderName& n : names) {
    const TmShader* shader = shaders.find(n.name, n.kind, path, n.beside);
    if (!shader) continue;
    for (std::string& file : shaders.filesOf(*shader)) files.insert(std::move(file));
    RslReads reads = rslReads(*shader);
    if (!reads.isKnown) return std::nullopt;
    pictures.insert(reads.names.begin(), reads.names.end());
  }
  uint64_t sum = 0;
  for (const std::string& file : files) sum = contentSum(sum, fileStamp(file));
  for (const std::string& picture : pictures)
    if (const uint64_t stamps = stampsOfPicture(picture, pathOf(scene.options.searchPaths, "texture")))
      sum = contentSum(sum, uint64_t{stamps});
  return sum;
}

bool holds(const DisplayCall& display, const std::string& contents, const PixelRect& crop) {
  std::string error;
  const auto picture = openPicture(fileOf(display), error);
  if (!picture || picture->text(kContents) != contents || picture->text(kFinishedShare) != kAllFinished) return false;
  const PictureShape& s = picture->shape();
  return s.x == crop.x0 && s.y == crop.y0 && s.width == crop.width() && s.height == crop.height();
}

void addToPictures(Options& options, const char* name, const std::string& text, const RenderSettings& settings) {
  for (DisplayCall& d : options.displays)
    if (driverOf(d, options, pluginTrust(settings)).empty()) addHeader(d, name, text);
}

}  // namespace

std::string contentsOf(const Scene& scene, ShaderRegistry& shaders, const RenderSettings& settings) {
  const std::string given = settings.stored.irradiance + settings.stored.bakedFolder + settings.stored.atlasFolder;
  if (!scene.procedurals.empty() || !given.empty()) return {};
  Options options = scene.options;
  const Options usual;
  options.bucketWidth = usual.bucketWidth;
  options.bucketHeight = usual.bucketHeight;
  options.bucketOrder = usual.bucketOrder;
  options.searchPaths.clear();
  options.user.clear();                   // worldSum() includes those that matter
  options.cropWindow = usual.cropWindow;  // pictures have windows of their own
  for (DisplayCall& d : options.displays) {
    d.where = {};
    d.name.clear();
  }
  const std::optional<uint64_t> ofShaders = shaderSum(scene, shaders);
  if (!ofShaders) return {};
  Motion camera = scene.cameraFromWorld;
  const std::string version = std::string(kVersion) + sourceCommit(), text = settingsText(settings);
  return fmt::format("{:016x}",
                     contentSum(worldSum(scene, false), uint64_t{*ofShaders}, options, camera, version, text));
}

void describeOutputs(Options& options, const std::string& contents, const RenderSettings& settings) {
  addToPictures(options, kVersionOf, kVersion, settings);
  addToPictures(options, kCommit, sourceCommit(), settings);
  addToPictures(options, kScene, sceneText(settings), settings);
  addToPictures(options, kFrame, std::to_string(options.frame), settings);
  addToPictures(options, kFinishedShare, kAllFinished, settings);
  addToPictures(options, kSettings, settingsText(settings), settings);
  if (!contents.empty()) addToPictures(options, kContents, contents, settings);
}

void makeRoomForStatistics(Options& options, const RenderSettings& settings) {
  if (settings.report.statsHeader) addToPictures(options, kStatistics, std::string(kStatisticsRoom, ' '), settings);
}

std::string sumOfShot(const Shot& shot, uint64_t irradiance, const std::vector<SourceFile>& edits) {
  uint64_t sum = irradiance;
  int world = shot.world;
  uint32_t seed = shot.seed;
  for (const auto* files : {&shot.sources, &edits})
    for (const SourceFile& file : *files) sum = contentSum(sum, uint64_t{file.sum});
  return fmt::format("{:016x}", contentSum(sum, world, seed));
}

std::string contentsOfGather(const Shot& shot, uint64_t buckets, ShaderRegistry& shaders, const std::string& sum,
                             const RenderSettings& settings) {
  const std::optional<uint64_t> ofShaders = shaderSum(shot.scene, shaders);
  if (!settings.stored.atlasFolder.empty() || !ofShaders) return {};
  const PixelRect& crop = shot.frame.crop;
  return fmt::format("{} {} {:016x} {:016x} {} {} {} {} {}", std::string(kVersion) + sourceCommit(), sum, buckets,
                     *ofShaders, settingsText(settings), crop.x0, crop.y0, crop.x1, crop.y1);
}

void describeShot(Options& options, const std::string& sum, const RenderSettings& settings) {
  addToPictures(options, kShot, sum, settings);
}

void describeGather(Options& options, const RenderSettings& settings) {
  if (options.cropWindow != Options().cropWindow)
    addToPictures(options, kGathered, fmt::format("{}", fmt::join(options.cropWindow, ",")), settings);
}

void describeAudit(Options& options, const std::string& sentence, const RenderSettings& settings) {
  addToPictures(options, kAudit, sentence, settings);
}

void describeQuality(Options& options, const std::string& chosen, const RenderSettings& settings) {
  addToPictures(options, kChosen, chosen, settings);
}

bool isFinished(const Options& options, const std::string& contents, const RenderSettings& settings, Log& log) {
  const auto rendered = [&](const SourceLoc& where, const std::string& why) {
    log.report(Severity::Note, "frame-unknown", where, "--skip-finished: " + why + ", so its frames are rendered");
    return false;
  };
  if (contents.empty())
    return rendered(
        {}, "procedurals, files of light, or files whose names shaders compute are read while the scene is rendered");
  for (const DisplayCall& d : options.displays) {
    const bool isFile = driverOf(d, options, pluginTrust(settings)).empty();
    DisplayCall described = d;
    if (isFile) addHeader(described, kContents, contents);
    if (described.params.size() == d.params.size())
      return rendered(d.where, "\"" + d.name + "\" has no header that tells what it holds");
    if (!holds(d, contents, Camera(options).crop())) return false;
  }
  return true;
}

}  // namespace tomales

#include "reyes/app/commands/info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>

#include "gi/brick_file.h"
#include "gi/icf.h"
#include "gi/point_file.h"
#include "reyes/app/commands/foreign_file.h"
#include "reyes/app/commands/scene_info.h"
#include "reyes/app/exit_code.h"
#include "reyes/app/settings.h"
#include "reyes/dfb.h"
#include "reyes/image.h"
#include "reyes/image_files.h"
#include "reyes/pictures.h"

namespace tomales {
namespace {

Json channelInfo(const Image& image, size_t channel) {
  double sum = 0;
  float low = kInfinity, high = -kInfinity;
  int64_t finite = 0, strange = 0;
  for (size_t i = channel; i < image.pixels.size(); i += image.channels.size()) {
    const float v = image.pixels[i];
    if (!std::isfinite(v)) {
      ++strange;
      continue;
    }
    low = std::min(low, v);
    high = std::max(high, v);
    sum += static_cast<double>(v);
    ++finite;
  }
  return {{"name", image.channels[channel]},
          {"min", low},
          {"max", high},
          {"mean", finite > 0 ? sum / static_cast<double>(finite) : 0.0},
          {"not_finite", strange}};
}

/// Returns all samples of a deep picture as one row of pixels; nothing for a picture that is flat or damaged.
std::optional<Image> samplesOf(const std::string& file) {
  std::string error;
  const auto in = openPicture(file, error);
  std::vector<uint32_t> counts;
  Image row;
  if (!in || !in->deep() || !in->readDeep(counts, row.pixels)) return std::nullopt;
  row.channels = in->shape().channels;
  row.width = static_cast<int>(row.pixels.size() / std::max<size_t>(1, row.channels.size()));
  return row;
}

Json imageInfo(const std::string& file, Log& log) {
  std::string error;
  const std::optional<Image> image = readImage(file, error);
  if (!image) {
    log.report(Severity::Error, "image-read", {std::make_shared<std::string>(file), 0},
               "cannot be read as a picture: " + error);
    return {};
  }
  // Where samples lie before each other, only colours add up, so the figures of a deep picture are those of its
  // samples.
  const std::optional<Image> samples = samplesOf(file);
  Json channels = Json::array();
  for (size_t c = 0; c < image->channels.size(); ++c) channels.push_back(channelInfo(samples ? *samples : *image, c));
  Json out = {{"file", file},
              {"kind", "image"},
              {"size", {image->width, image->height}},
              {"origin", {image->originX, image->originY}},
              {"display_size", {image->displayWidth, image->displayHeight}}};
  if (samples) out["deep_samples"] = samples->width;
  out["channels"] = channels;
  return out;
}

void unreadable(const std::string& file, const char* kind, const std::string& error, Log& log) {
  log.report(Severity::Error, "file-read", {std::make_shared<std::string>(file), 0},
             fmt::format("cannot be read as {}: {}", kind, error));
}

Json dfbInfo(const std::string& file, Log& log) {
  std::string error;
  const auto dfb = DfbFile::open(file, error);
  if (!dfb) {
    unreadable(file, "a deep frame buffer", error, log);
    return Json{};
  }
  const Shot& shot = dfb->shot();
  int64_t points = 0, facets = 0, fragments = 0;
  for (size_t i = 0; i < shot.frame.tileCount(); ++i) {
    const auto tile = dfb->tile(i, error);
    if (!tile) {
      unreadable(file, "a deep frame buffer", error, log);
      return Json{};
    }
    for (const ShadePoints& batch : tile->batches) points += batch.count();
    facets += static_cast<int64_t>(tile->facets.size());
    fragments += static_cast<int64_t>(tile->fragments.size());
  }
  Json sources = Json::array(), lights = Json::array(), objects = Json::array();
  for (const SourceFile& source : shot.sources) sources.push_back(source.path);
  for (const auto& light : shot.scene.lights)
    lights.push_back({{"handle", light->handle}, {"shader", light->shader.name}});
  std::set<std::string> names;
  for (const ShadeGroup& group : shot.scene.groups)
    if (!group.attributes->name.empty()) names.insert(group.attributes->name);
  const PixelRect& crop = shot.frame.crop;
  return {{"file", file},
          {"kind", "dfb"},
          {"bytes", dfb->size()},
          {"shot", fmt::format("{:016x}", dfb->shotSum())},
          {"frame", shot.scene.options.frame},
          {"resolution", {shot.scene.options.xResolution, shot.scene.options.yResolution}},
          {"crop", {crop.x0, crop.y0, crop.x1, crop.y1}},
          {"samples_per_pixel", shot.frame.samplesPerPixel},
          {"bucket", {shot.frame.bucketWidth, shot.frame.bucketHeight}},
          {"buckets", shot.frame.tileCount()},
          {"micropolygons_visible", facets},
          {"points", points},
          {"fragments", fragments},
          {"shade_groups", shot.scene.groups.size()},
          {"names", names},
          {"lights", lights},
          {"sources", sources}};
}

Json icfInfo(const std::string& file, Log& log) {
  std::string error;
  const auto icf = IcfFile::open(file, error);
  if (!icf || !icf->intact(error)) {
    unreadable(file, "an irradiance cache", error, log);
    return Json{};
  }
  Json caches = Json::array();
  for (const PreparedCache& c : icf->shot().caches) {
    vec3 mean(0.0f);
    for (const IrradianceRecord& r : c.cache.records())
      mean += r.light.E / static_cast<float>(c.cache.records().size());
    caches.push_back({{"records", c.cache.records().size()},
                      {"frames", c.frames.size()},
                      {"error_function", infoOf(c.key.cache.errorFunction).name},
                      {"kappa", c.key.cache.kappa},
                      {"samples", c.key.gather.samples},
                      {"mean_irradiance_over_pi", {mean.x, mean.y, mean.z}}});
  }
  return {{"file", file},
          {"kind", "icf"},
          {"bytes", icf->size()},
          {"shot", fmt::format("{:016x}", icf->shot().shot)},
          {"caches", caches}};
}

/// Prints a line "name: value" for each, indented by depth.
void printText(const Json& j, int depth) {
  for (const auto& [key, value] : j.items()) {
    const std::string indent(static_cast<size_t>(2 * depth), ' ');
    if (value.is_structured() && !isScalarList(value)) {
      std::puts(fmt::format("{}{}:", indent, j.is_array() ? "- " + key : key).c_str());
      printText(value, depth + 1);
    } else {
      std::puts(fmt::format("{}{}: {}", indent, key, lineOf(value)).c_str());
    }
  }
}

Json channelsOf(const std::vector<CloudChannel>& channels) {
  Json out = Json::array();
  for (const CloudChannel& c : channels) out.push_back({{"name", c.name}, {"floats", c.width}});
  return out;
}

Json pointsInfo(const std::string& file) {
  const PointFile points(file);
  const Bound3 b = points.bound();
  return {{"file", file},
          {"kind", "points"},
          {"points", points.count()},
          {"channels", channelsOf(points.channels())},
          {"bound", {{"min", {b.lo.x, b.lo.y, b.lo.z}}, {"max", {b.hi.x, b.hi.y, b.hi.z}}}},
          {"chunks", points.chunkCount()},
          {"bytes", points.fileBytes()}};
}

Json bricksInfo(const std::string& file) {
  const BrickFile map(file);
  const BrickCube& c = map.tree().cube;
  return {{"file", file},
          {"kind", "bricks"},
          {"bricks", map.tree().nodes.size()},
          {"levels", map.tree().nodes.empty() ? 0 : map.tree().deepest + 1},
          {"channels", channelsOf(map.channels())},
          {"cube", {{"corner", {c.lo.x, c.lo.y, c.lo.z}}, {"size", c.size}}},
          {"bytes", map.fileBytes()}};
}

/// Describes files of our own formats, whose readers report errors themselves.
Json ownInfo(const std::string& file, Json (*infoOfKind)(const std::string&), Log& log) {
  try {
    return infoOfKind(file);
  } catch (const FileError& e) {
    log.report(Severity::Error, "file", {}, e.what());
    return {};
  }
}

Json infoOf(const std::string& file, const Trust& trust, Log& log) {
  const std::string extension = std::filesystem::path(file).extension().string();
  std::error_code none;
  const bool named = extension.empty() && file != "-" && file.find('/') == std::string::npos;
  if (named && !std::filesystem::exists(file, none)) return namedShaderInfo(file, pluginTrust(trust), log);
  if (extension == ".ptc" || extension == ".bkm")
    return ownInfo(file, extension == ".ptc" ? pointsInfo : bricksInfo, log);
  if (isPicture(file)) return imageInfo(file, log);
  if (file.ends_with(".dfb")) return dfbInfo(file, log);
  if (file.ends_with(".icf")) return icfInfo(file, log);
  if (file.ends_with(".sl")) return textInfo(file, log);
  if (extension == ".so") return pluginInfo(file, log);
  return isForeign(file, log) ? Json{} : sceneInfo(file, trust, log);
}

}  // namespace

int infoCommand(const InfoCommand& command) {
  Log log;
  Json info = infoOf(command.file, command.trust, log);
  const int64_t missing = info.contains("needs") ? missingOf(info.at("needs")) : 0;
  if (command.json && !info.is_null()) {
    std::puts(info.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  } else if (!info.is_null()) {
    const Json needs = info.value("needs", Json());
    info.erase("needs");
    info.erase("missing");
    printText(info, 0);
    if (!needs.is_null()) printNeeds(needs);
  }
  return missing > 0 ? std::max(exitCodeOf(log), kIncomplete) : exitCodeOf(log);
}

}  // namespace tomales

#include "reyes/app/commands/info.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "gi/brick_file.h"
#include "gi/icf.h"
#include "gi/point_file.h"
#include "reyes/app/exit_code.h"
#include "reyes/app/settings.h"
#include "reyes/base/apart.h"
#include "reyes/dfb.h"
#include "reyes/image.h"
#include "reyes/rib.h"
#include "reyes/shade.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

using Json = nlohmann::ordered_json;

Json sceneInfo(const Scene& scene) {
  std::set<std::string> shaders;
  int64_t patches = 0;
  for (const Object& object : scene.objects) {
    patches += object.shape().patchCount();
    for (const auto& call : {object.attributes->surface, object.attributes->displacement})
      if (call) shaders.insert(call->name);
  }
  for (const auto& light : scene.lights) shaders.insert(light->shader.name);
  Json displays = Json::array();
  for (const DisplayCall& d : scene.options.displays)
    displays.push_back({{"name", d.name}, {"type", d.type}, {"mode", d.mode}});
  return {{"frame", scene.options.frame},
          {"resolution", {scene.options.xResolution, scene.options.yResolution}},
          {"pixel_samples", {scene.options.xSamples, scene.options.ySamples}},
          {"objects", scene.objects.size()},
          {"procedurals", scene.procedurals.size()},
          {"patches", patches},
          {"lights", scene.lights.size()},
          {"shade_groups", scene.groups.size()},
          {"shaders", shaders},
          {"displays", displays}};
}

Json ribInfo(const std::string& file, Log& log) {
  Json frames = Json::array();
  RibSettings rib;
  rib.onScene = [&](Scene&& scene) { frames.push_back(sceneInfo(scene)); };
  readRib({file}, rib, log);
  return {{"file", file}, {"kind", "rib"}, {"frames", frames}};
}

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
    low = std::min(low, v), high = std::max(high, v), sum += static_cast<double>(v), ++finite;
  }
  return {{"name", image.channels[channel]},
          {"min", low},
          {"max", high},
          {"mean", finite > 0 ? sum / static_cast<double>(finite) : 0.0},
          {"not_finite", strange}};
}

Json imageInfo(const std::string& file, Log& log) {
  std::string error;
  const std::optional<Image> image = readImage(file, error);
  if (!image) {
    log.report(Severity::Error, "image-read", {std::make_shared<std::string>(file), 0},
               "cannot be read as a picture: " + error);
    return {};
  }
  Json channels = Json::array();
  for (size_t c = 0; c < image->channels.size(); ++c) channels.push_back(channelInfo(*image, c));
  return {{"file", file},
          {"kind", "image"},
          {"size", {image->width, image->height}},
          {"origin", {image->originX, image->originY}},
          {"display_size", {image->displayWidth, image->displayHeight}},
          {"channels", channels}};
}

Json defaultOf(const TmParamDecl& p) {
  static constexpr int kFloats[] = {1, 3, 3, 3, 3, 0, 16};
  const int32_t type = TM_TYPE_OF(p.type);
  Json value = Json::array();
  for (int i = 0; i < p.arrayLength * kFloats[type]; ++i) value.push_back(p.floats ? p.floats[i] : 0.0f);
  for (int i = 0; type == TM_STRING && p.strings && i < p.arrayLength; ++i) value.push_back(p.strings[i]);
  return value;
}

Json paramInfo(const TmParamDecl& p) {
  static constexpr const char* kTypes[] = {"float", "color", "point", "vector", "normal", "string", "matrix"};
  const int32_t type = TM_TYPE_OF(p.type);
  const bool known = type >= TM_FLOAT && type <= TM_MATRIX, output = (p.type & TM_OUTPUT) != 0;
  Json out = {{"name", p.name}, {"type", known ? std::string(output ? "output " : "") + kTypes[type] : "?"}};
  if (!output) out["default"] = known ? defaultOf(p) : Json::array();
  out["doc"] = p.doc ? p.doc : "";
  if (const char* role = roleName(p.role)) out["role"] = role;
  return out;
}

/// What a scene may give to an output, which is a parameter of its own. Null: nothing.
const TmParamDecl* inputOf(const TmShader& s, const TmParamDecl& output) {
  for (int i = 0; i < s.paramCount; ++i)
    if (!(s.params[i].type & TM_OUTPUT) && std::string_view(s.params[i].name) == output.name) return &s.params[i];
  return nullptr;
}

bool hasOutput(const TmShader& s, const TmParamDecl& input) {
  return std::any_of(s.params, s.params + s.paramCount, [&](const TmParamDecl& p) {
    return (p.type & TM_OUTPUT) != 0 && std::string_view(p.name) == input.name;
  });
}

Json shaderInfo(const TmShader& s) {
  Json params = Json::array();
  for (int i = 0; i < s.paramCount; ++i) {
    const TmParamDecl& p = s.params[i];
    const bool output = (p.type & TM_OUTPUT) != 0;
    if (!output && hasOutput(s, p)) continue;
    params.push_back(paramInfo(p));
    if (const TmParamDecl* input = output ? inputOf(s, p) : nullptr) params.back()["default"] = defaultOf(*input);
  }
  Json standard = Json::array();
  for (const TmParamDecl& p : standardParams(static_cast<TmKind>(s.kind))) standard.push_back(paramInfo(p));
  return {{"name", s.name},
          {"kind", s.kind >= 0 && s.kind <= TM_IMAGER ? kindName(static_cast<TmKind>(s.kind)) : "?"},
          {"doc", s.doc ? s.doc : ""},
          {"parameters", params},
          {"standard_parameters", standard}};
}

/// Of a file in the shading language.
Json textInfo(const std::string& path, Log& log) {
  const auto file = RslFile::compile(path, {});
  if (file->errors() > 0) {
    log.report(Severity::Error, "shader-read", {}, file->messages());
    return {};
  }
  Json shaders = Json::array();
  for (int32_t k = 0; k < file->library()->count; ++k) {
    const TmShader& shader = *file->library()->shaders[k];
    Json about = shaderInfo(shader);
    const std::vector<RslParameter> details = file->parameters(shader);
    for (size_t at = 0; at < details.size(); ++at)
      for (Json& p : about["parameters"]) {
        if (p["name"] != shader.params[at].name) continue;
        if (!details[at].detail.empty()) p["detail"] = details[at].detail;
        if (details[at].computed) p["default"] = "computed";
      }
    shaders.push_back(std::move(about));
  }
  return {{"file", path}, {"kind", "shaders"}, {"shaders", shaders}};
}

/// Its code runs, and may crash, in a process of its own.
Json pluginInfo(const std::string& file, Log& log) {
  constexpr int kMostSeconds = 20;
  const auto describe = [&] {
    ShaderRegistry registry(log);
    if (!registry.loadPlugin(std::filesystem::absolute(file).string())) return std::string();
    Json shaders = Json::array();
    for (const TmShader* shader : registry.all()) shaders.push_back(shaderInfo(*shader));
    return shaders.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  std::string fate = "is not a shader plugin of this version";
  const std::string shaders = madeApart(describe, kMostSeconds, fate).value_or("");
  if (!shaders.empty()) return {{"file", file}, {"kind", "shaders"}, {"shaders", Json::parse(shaders)}};
  log.report(Severity::Error, "plugin-read", {std::make_shared<std::string>(file), 0}, fate);
  return {};
}

void unreadable(const std::string& file, const char* kind, const std::string& error, Log& log) {
  log.report(Severity::Error, "file-read", {std::make_shared<std::string>(file), 0},
             fmt::format("cannot be read as {}: {}", kind, error));
}

Json dfbInfo(const std::string& file, Log& log) {
  std::string error;
  const auto dfb = DfbFile::open(file, error);
  if (!dfb) return unreadable(file, "a deep frame buffer", error, log), Json{};
  const Shot& shot = dfb->shot();
  int64_t points = 0, facets = 0, fragments = 0;
  for (size_t i = 0; i < shot.frame.tileCount(); ++i) {
    const auto tile = dfb->tile(i, error);
    if (!tile) return unreadable(file, "a deep frame buffer", error, log), Json{};
    for (const ShadePoints& batch : tile->batches) points += batch.count();
    facets += static_cast<int64_t>(tile->facets.size()), fragments += static_cast<int64_t>(tile->fragments.size());
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
  if (!icf || !icf->intact(error)) return unreadable(file, "an irradiance cache", error, log), Json{};
  Json caches = Json::array();
  for (const PreparedCache& c : icf->shot().caches) {
    vec3 mean(0.0f);
    for (const IrradianceRecord& r : c.cache.records()) mean += r.E / static_cast<float>(c.cache.records().size());
    caches.push_back({{"records", c.cache.records().size()},
                      {"frames", c.frames.size()},
                      {"error_function", infoOf(c.plan.cache.errorFunction).name},
                      {"kappa", c.plan.cache.kappa},
                      {"samples", c.plan.gather.samples},
                      {"mean_irradiance_over_pi", {mean.x, mean.y, mean.z}}});
  }
  return {{"file", file},
          {"kind", "icf"},
          {"bytes", icf->size()},
          {"shot", fmt::format("{:016x}", icf->shot().shot)},
          {"caches", caches}};
}

bool isScalarList(const Json& j) {
  return j.is_array() && std::none_of(j.begin(), j.end(), [](const Json& e) { return e.is_structured(); });
}

/// One "name: value" a line, indented by depth.
void printText(const Json& j, int depth) {
  for (const auto& [key, value] : j.items()) {
    const std::string indent(static_cast<size_t>(2 * depth), ' ');
    if (value.is_structured() && !isScalarList(value)) {
      std::puts(fmt::format("{}{}:", indent, j.is_array() ? "- " + key : key).c_str());
      printText(value, depth + 1);
    } else {
      const std::string text =
          value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', false, Json::error_handler_t::replace);
      std::puts(fmt::format("{}{}: {}", indent, key, text).c_str());
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

/// Files of our own that say themselves what is wrong with them.
Json ownInfo(const std::string& file, Json (*infoOfKind)(const std::string&), Log& log) {
  try {
    return infoOfKind(file);
  } catch (const FileError& e) {
    log.report(Severity::Error, "file", {}, e.what());
    return {};
  }
}

Json infoOf(const std::string& file, Log& log) {
  if (const auto extension = std::filesystem::path(file).extension(); extension == ".ptc" || extension == ".bkm")
    return ownInfo(file, extension == ".ptc" ? pointsInfo : bricksInfo, log);
  if (namesPicture(file)) return imageInfo(file, log);
  if (file.ends_with(".dfb")) return dfbInfo(file, log);
  if (file.ends_with(".icf")) return icfInfo(file, log);
  if (file.ends_with(".sl")) return textInfo(file, log);
  return std::filesystem::path(file).extension() == ".so" ? pluginInfo(file, log) : ribInfo(file, log);
}

}  // namespace

int infoCommand(const std::string& file, bool json) {
  Log log;
  const Json info = infoOf(file, log);
  if (json && !info.is_null())
    std::puts(info.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  else if (!info.is_null())
    printText(info, 0);
  return exitCodeOf(log);
}

}  // namespace tomales

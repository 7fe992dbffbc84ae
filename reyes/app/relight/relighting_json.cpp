// The answers to a page that asks about a shot and its shading.
#include <set>

#include "reyes/app/relight/relighting.h"
#include "reyes/app/relight/relighting_layers.h"
#include "reyes/surface_variables.h"

namespace tomales {
namespace {

/// A point p of the shader's space is at pixel (x/w, y/w) of the window, with (x, y, z, w) = the matrix by columns
/// times (p, 1); in front of the eye w is positive.
mat4 pixelFromWorld(const Scene& scene, const PixelRect& window) {
  const Camera camera(scene.options);
  const vec2 half = 0.5f * vec2(camera.xResolution(), camera.yResolution());
  mat4 pixelFromScreen(1.0f);
  pixelFromScreen[0][0] = half.x;
  pixelFromScreen[1][1] = -half.y;
  pixelFromScreen[3] = {half - vec2(window.x0, window.y0), 0, 1};
  return pixelFromScreen * viewOf(camera, scene.cameraFromWorldAtOpen()).screenFromWorld;
}

Json jsonOf(const mat4& m) { return std::vector<float>(&m[0][0], &m[0][0] + 16); }
Json jsonOf(const PixelRect& r) { return {r.x0, r.y0, r.x1, r.y1}; }

Json jsonOf(const EditableShader& s) {
  Json params = Json::array();
  for (const EditableParam& p : s.params)
    params.push_back({{"name", p.name},
                      {"type", p.type},
                      {"value", jsonOf(p.value)},
                      {"doc", p.doc},
                      {"role", p.role == TM_ROLE_NONE ? Json() : Json(roleName(p.role))}});
  return {{"owner", s.owner}, {"shader", s.shader}, {"params", params}};
}

}  // namespace

std::vector<std::string> variablesOf(const Options& options) {
  std::set<std::string> out;
  for (const SurfaceVariable& v : kSurfaceVariables)
    if ((v.kind == ChannelKind::Variable && v.source != VariableSource::Noise) || v.name == "a" || v.name == "z")
      out.emplace(v.name);
  for (const auto& [name, channel] : options.channels) out.insert(name);
  return {out.begin(), out.end()};
}

vec3 variableAt(const Image& rows, int x, int y, const std::string& variable) {
  constexpr int kAlpha = 3, kDepth = 4, kFirst = 5;  // R G B A Z come first
  const float* pixel = rows.at(x, y);
  if (rows.channelCount() >= kFirst + 3) return {pixel[kFirst], pixel[kFirst + 1], pixel[kFirst + 2]};
  return vec3(pixel[rows.channelCount() > kFirst ? kFirst : variable == "z" ? kDepth : kAlpha]);
}

Json Relighting::preparation() const {
  const std::lock_guard lock(mutex_);
  return {{"doing", doing_}, {"done", done_}};
}

Json Relighting::description() const {
  const std::lock_guard lock(mutex_);
  const mat4 pixels = pixelFromWorld(files_->dfb().shot().scene, window_);
  Json layers = Json::array(), objects = Json::array();
  for (size_t i = 0; i + 1 < list_.size(); ++i)
    layers.push_back({{"name", list_[i].name}, {"lights", list_[i].handles}});
  for (const EditableObject& o : editable_->objects())
    objects.push_back({{"name", o.name}, {"color", {o.color.x, o.color.y, o.color.z}}, {"lights", o.lights}});
  Json out = {{"file", settings_.input.files.front()},
              {"width", window_.width()},
              {"height", window_.height()},
              {"exposure", editable_->exposure()},
              {"present", tomales::jsonOf(present_)},
              {"sharesBounces", sharesBounces_},
              {"layers", layers},
              {"objects", objects},
              {"variables", variablesOf(files_->dfb().shot().scene.options)}};
  for (size_t slot = 0; slot < kShaderSlots; ++slot) {
    Json& shaders = out[kSlots[slot].key] = Json::array();
    for (const EditableShader& s : editable_->of(static_cast<ShaderSlot>(slot))) {
      shaders.push_back(jsonOf(s));
      if (slot == kLights) shaders.back()["pixelFromShader"] = jsonOf(pixels * s.worldFromShader);
    }
  }
  return out;
}

Json Relighting::offered() const {
  Json out = Json::object();
  for (size_t slot = 0; slot < kShaderSlots; ++slot)
    out[kSlots[slot].key] = editable_->offered(static_cast<ShaderSlot>(slot));
  return out;
}

Json Relighting::offeredShader(const std::string& kind, const std::string& name) const {
  const auto slot = std::ranges::find(kSlots, kind, &ShaderSlotInfo::key);
  const EditableShader* shader = slot == std::end(kSlots)
                                     ? nullptr
                                     : editable_->describe(static_cast<ShaderSlot>(slot - std::begin(kSlots)), name);
  if (!shader) throw BadRequest("there is no such shader");
  return jsonOf(*shader);
}

Json Relighting::status() const {
  const std::lock_guard lock(mutex_);
  Json layers = Json::array();
  const auto left = [](const LayerParts& parts) {
    return static_cast<double>(parts.old()) / static_cast<double>(parts.count());
  };
  for (size_t i = 0; i + 1 < list_.size(); ++i) {
    const Layer& layer = list_[i];
    vec3 unit(1.0f);
    if (layer.handles.size() == 1)
      for (const EditableParam& p : shaderUnder(present_, kLights, layer.handles.front(), *editable_).params)
        if (isFactor(p.role)) {
          const std::vector<float> value = unitOf(p);
          unit *= value.size() == 3 ? vec3(value[0], value[1], value[2]) : vec3(value[0]);
        }
    layers.push_back({{"version", layer.parts.wanted()},
                      {"unit", {unit.x, unit.y, unit.z}},
                      {"old", layer.parts.areOld()},
                      {"left", left(layer.parts)}});
  }
  Json messages = Json::array(), gathered = Json::array();
  for (const LogEntry& e : log_.entries())
    if (e.severity >= Severity::Warning) messages.push_back(e.message);
  for (const PixelRect& r : gathered_) gathered.push_back(jsonOf(r));
  return {
      {"present", tomales::jsonOf(present_)},
      {"doing", doing_},
      {"done", done_},
      {"layers", layers},
      {"variable", {{"name", variable_}, {"version", list_.back().parts.wanted()}, {"left", left(list_.back().parts)}}},
      {"notLinear", notLinear_},
      {"stale", stale_},
      {"gathered", gathered},
      {"gathering", toGather_.has_value()},
      {"checked", checked_},
      {"messages", messages},
      {"imager", files_->dfb().shot().scene.options.imager.has_value() || !present_.shaders[kImagers].empty()},
      {"bytes", layers_->bytes()}};
}

std::optional<int> groupAt(const DeepTile& tile, int x, int y) {
  const DeepPixel& pixel = tile.pixel(x, y);
  if (pixel.count == 0) return std::nullopt;
  const Facet& nearest = tile.facets[tile.fragments[pixel.first].facet];
  return tile.batches[static_cast<size_t>(nearest.batch)].group();
}

Json Relighting::objectAt(int x, int y) const {
  const int atX = window_.x0 + x, atY = window_.y0 + y;
  if (!window_.contains(atX, atY)) throw BadRequest("this pixel is outside of the picture");
  const auto shot = files();
  std::string error;
  const auto tile = shot->dfb().tile(shot->dfb().shot().frame.tileOf(atX, atY), error);
  const std::optional<int> group = tile ? groupAt(*tile, atX, atY) : std::nullopt;
  if (!group) return Json::object();
  const Attributes& a = *shot->dfb().shot().scene.groups[static_cast<size_t>(*group)].attributes;
  return {{"object", a.name}, {"shader", a.surface ? a.surface->name : "defaultsurface"}};
}

}  // namespace tomales

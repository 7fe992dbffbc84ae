// What a page asks about a shot and its shading.
#include "reyes/app/relight/relighting.h"

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

}  // namespace

Json Relighting::description() const {
  const std::lock_guard lock(mutex_);
  const mat4 pixels = pixelFromWorld(files_->dfb().shot().scene, window_);
  const auto shaders = [&](const std::vector<EditableShader>& all) {
    Json out = Json::array();
    for (const EditableShader& s : all) {
      Json params = Json::array();
      for (const EditableParam& p : s.params)
        params.push_back({{"name", p.name},
                          {"type", p.type},
                          {"value", p.value},
                          {"doc", p.doc},
                          {"role", p.role == TM_ROLE_NONE ? Json() : Json(roleName(p.role))}});
      out.push_back({{"owner", s.owner},
                     {"shader", s.shader},
                     {"pixelFromShader", jsonOf(pixels * s.worldFromShader)},
                     {"params", params}});
    }
    return out;
  };
  Json layers = Json::array();
  for (const Layer& layer : list_) layers.push_back({{"name", layer.name}, {"lights", layer.handles}});
  return {{"file", settings_.files.front()},     {"width", window_.width()},
          {"height", window_.height()},          {"exposure", editable_.exposure},
          {"present", jsonOf(present_)},         {"imager", files_->dfb().shot().scene.options.imager.has_value()},
          {"sharesBounces", sharesBounces_},     {"layers", layers},
          {"lights", shaders(editable_.lights)}, {"surfaces", shaders(editable_.surfaces)}};
}

Json Relighting::status() const {
  const std::lock_guard lock(mutex_);
  Json layers = Json::array();
  for (const Layer& layer : list_)
    layers.push_back({{"version", layer.version},
                      {"edit", layer.begun ? jsonOf(*layer.begun) : Json()},
                      {"old", isOld(layer, layer.shaded)}});
  Json messages = Json::array();
  for (const LogEntry& e : log_.entries())
    if (e.severity >= Severity::Warning) messages.push_back(e.message);
  return {{"present", jsonOf(present_)}, {"doing", doing_},     {"done", done_},        {"layers", layers},
          {"notLinear", notLinear_},     {"checked", checked_}, {"messages", messages}, {"bytes", layers_->bytes()}};
}

std::optional<int> Relighting::groupAt(int x, int y) const {
  const DeepFrame& frame = files_->dfb().shot().frame;
  const auto index = static_cast<size_t>(frame.rowOf(y) * frame.columns + (x - frame.padded.x0) / frame.bucketWidth);
  std::string error;
  const auto tile = files_->dfb().tile(index, error);
  if (!tile || tile->pixel(x, y).count == 0) return std::nullopt;
  const Facet& nearest = tile->facets[tile->fragments[tile->pixel(x, y).first].facet];
  return tile->batches[static_cast<size_t>(nearest.batch)].group();
}

Json Relighting::objectAt(int x, int y) const {
  const int atX = window_.x0 + x, atY = window_.y0 + y;
  if (!window_.contains(atX, atY)) throw BadRequest("this pixel is outside of the picture");
  const std::optional<int> group = groupAt(atX, atY);
  if (!group) return Json::object();
  const Attributes& a = *files_->dfb().shot().scene.groups[static_cast<size_t>(*group)].attributes;
  return {{"object", a.name}, {"shader", a.surface ? a.surface->name : "defaultsurface"}};
}

}  // namespace tomales

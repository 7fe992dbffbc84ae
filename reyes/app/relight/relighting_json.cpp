// Answers to requests of pages about a shot and its shading.
#include "reyes/app/relight/relighting.h"

namespace tomales {
namespace {

/// Returns a matrix M, stored by columns, that puts a point p of the world at pixel (x/w, y/w) of the window, with (x,
/// y, z, w) = M (p, 1). In front of the eye w is positive.
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

Json Relighting::preparation() const {
  const WorkStatus::Now now = status_.now();
  return {{"doing", now.doing}, {"done", now.done}};
}

Json Relighting::description() const {
  const auto files = shot_.files();
  const Scene& scene = files->dfb().shot().scene;
  const PixelRect& window = parts_->window();
  const mat4 pixels = pixelFromWorld(scene, window);
  Json objects = Json::array();
  for (const EditableObject& o : editable().objects())
    objects.push_back({{"name", o.name}, {"color", {o.color.x, o.color.y, o.color.z}}, {"lights", o.lights}});
  Json out = {{"file", file_},
              {"width", window.width()},
              {"height", window.height()},
              {"exposure", editable().exposure()},
              {"present", tomales::jsonOf(session_->present())},
              {"sharesBounces", sharesBounces_},
              {"layers", session_->layers()},
              {"objects", objects},
              {"variables", variablesOf(scene.options)}};
  for (size_t slot = 0; slot < kShaderSlots; ++slot) {
    Json& shaders = out[kSlots[slot].key] = Json::array();
    for (const EditableShader& s : editable().of(static_cast<ShaderSlot>(slot))) {
      shaders.push_back(jsonOf(s));
      if (slot == kLights) shaders.back()["pixelFromShader"] = jsonOf(pixels * s.worldFromShader);
    }
  }
  return out;
}

Json Relighting::offered() const {
  Json out = Json::object();
  for (size_t slot = 0; slot < kShaderSlots; ++slot)
    out[kSlots[slot].key] = editable().offered(static_cast<ShaderSlot>(slot));
  return out;
}

Json Relighting::offeredShader(const std::string& kind, const std::string& name) const {
  const auto slot = std::ranges::find(kSlots, kind, &ShaderSlotInfo::key);
  const EditableShader* shader = slot == std::end(kSlots)
                                     ? nullptr
                                     : editable().describe(static_cast<ShaderSlot>(slot - std::begin(kSlots)), name);
  if (!shader) throw BadRequest("there is no such shader");
  return jsonOf(*shader);
}

Json Relighting::status() const {
  const WorkStatus::Now now = status_.now();  // before the layers, which are done if nothing is being done
  Json out = session_->status();
  out["doing"] = now.doing;
  out["done"] = now.done;
  Json& messages = out["messages"] = Json::array();
  for (const LogEntry& e : log_.entries())
    if (e.severity >= Severity::Warning) messages.push_back(e.message);
  if (shot_.files()->dfb().shot().scene.options.imager) out["imager"] = true;
  out["bytes"] = layers().bytes();
  return out;
}

Json Relighting::objectAt(int x, int y) const {
  const PixelRect& window = parts_->window();
  const int atX = window.x0 + x, atY = window.y0 + y;
  if (!window.contains(atX, atY)) throw BadRequest("this pixel is outside of the picture");
  const auto files = shot_.files();
  const Shot& shot = files->dfb().shot();
  std::string error;
  const auto tile = files->dfb().tile(shot.frame.tileOf(atX, atY), error);
  const Attributes* nearest = tile ? nearestAt(shot, *tile, atX, atY) : nullptr;
  if (!nearest) return Json::object();
  return {{"object", nearest->name}, {"shader", nearest->surface ? nearest->surface->name : "defaultsurface"}};
}

}  // namespace tomales

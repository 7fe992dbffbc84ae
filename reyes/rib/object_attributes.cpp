#include "reyes/rib/object_attributes.h"

#include "reyes/output.h"

namespace tomales::rib {
namespace {

/// Returns the strings of a primitive that need no interpolation, because they have one value for all of it.
ParamList stringsOf(const Request& r) {
  ParamList out;
  const bool has = r.name != "Points" && r.name != "Geometry" && r.name != "Volume";  // their strings say what they are
  for (const Param& p : r.params)
    if (has && p.type == ValueType::String && p.strings.size() == 1 &&
        (p.storage == Storage::Constant || p.storage == Storage::Uniform)) {
      out.push_back(p);
      out.back().storage = Storage::Constant;
    }
  return out;
}

/// Returns the call with the parameters that a primitive's values replace (RISpec 3.2 section 5, primitive variables).
std::shared_ptr<const ShaderCall> overridden(const ShaderCall& given, const ParamList& values) {
  auto call = std::make_shared<ShaderCall>(given);
  for (const Param& p : values) {
    std::erase_if(call->params, [&](const Param& old) { return old.name == p.name; });
    call->params.push_back(p);
  }
  return call;
}

// The camera sees only the far sides of the box, which are clear; what is in front of them is shaded as air. The
// material is that of Interior; without one, the object's color is the albedo.
std::shared_ptr<Attributes> attributesOfVolume(const Request& r, const GraphicsState& s) {
  auto out = std::make_shared<Attributes>(*s.scope.attributes);
  out->volume = true;
  out->opacity = vec3(0);
  out->insideOut = true;
  out->sides = 1;
  out->surface = std::make_shared<const ShaderCall>(ShaderCall{"constant", {}, s.scope.ctm, r.where});
  out->displacement = nullptr;
  out->displacementBound = 0;
  out->areaLight = -1;
  if (out->interior) return out;
  const auto color = [](const char* name, const vec3& c) {
    return Param{name, Storage::Uniform, ValueType::Color, 1, {c.x, c.y, c.z}, {}, {}};
  };
  const ParamList even{color("scattering", out->color), color("absorption", 1.0f - out->color)};
  out->interior = std::make_shared<const ShaderCall>(ShaderCall{"medium", even, s.scope.ctm, r.where});
  return out;
}

}  // namespace

std::shared_ptr<Attributes> attributesOf(const Request& r, GraphicsState& s) {
  if (r.name == "Volume") return attributesOfVolume(r, s);
  const std::shared_ptr<Attributes>& given = s.scope.attributes;
  const ParamList strings = stringsOf(r);
  const bool unseen = given->surface && given->surface->name == "null";
  if (!unseen && strings.empty()) return given;
  auto out = std::make_shared<Attributes>(*given);
  if (unseen) {
    out->surface = nullptr;
    if (shades(s.globals.options)) out->visibility = {false, false, false, false, false};
  }
  for (auto* call : {&out->surface, &out->displacement, &out->atmosphere})
    if (*call && !strings.empty()) *call = s.shaderInterner(overridden(**call, strings));
  return out;
}

}  // namespace tomales::rib

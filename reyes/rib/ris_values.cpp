// RenderMan 22 and later write former requests of RISpec as parameters of Option and Attribute "Ri".
#include <fmt/format.h>

#include <unordered_map>

#include "reyes/rib/handlers.h"
#include "reyes/rib/ris_parts.h"

namespace tomales::rib {
namespace {

std::vector<float> values(const Param& p) {
  return p.floats.empty() ? std::vector<float>(p.ints.begin(), p.ints.end()) : p.floats;
}

RibArg integer(int i) { return {RibArg::Kind::Integer, {static_cast<float>(i)}, {}, {i}}; }

// Each basis moves along its control points by its own step (RISpec 3.2 section 5.3).
bool sayBasis(Script& script, const std::string& name) {
  const std::optional<Basis> basis = basisNamed(name);
  if (!basis) return false;
  script.say("Basis", {string(name), integer(basis->step), string(name), integer(basis->step)});
  return true;
}

bool sayNumbers(Script& script, const Param& p, const std::vector<float>& v) {
  static const std::unordered_map<std::string_view, size_t> counts = {
      {"Clipping", 2}, {"Color", 3},        {"CropWindow", 4},  {"FrameAspectRatio", 1}, {"Matte", 1},
      {"Opacity", 3},  {"ScreenWindow", 4}, {"ShadingRate", 1}, {"Shutter", 2},          {"Sides", 1}};
  const auto it = counts.find(p.name);
  if (it == counts.end() || v.size() != it->second) return false;
  script.say(p.name.c_str(), {numbers(v)});
  return true;
}

// A Format of zero or less keeps the value that is set (RISpec 3.2 section 4.1.1).
bool say(Script& script, const Request& r, const Param& p) {
  const std::vector<float> v = values(p);
  const std::string word = wordOf(&p);
  if (sayNumbers(script, p, v)) return true;
  if (p.name == "FormatResolution" && v.size() == 2) {
    script.say("Format", {numbers({v[0], v[1], -1})});
    return true;
  }
  if (p.name == "FormatPixelAspectRatio" && v.size() == 1) {
    script.say("Format", {numbers({-1, -1, v[0]})});
    return true;
  }
  if (p.name == "Orientation") {
    script.say("Orientation", {string(word)});
    return true;
  }
  if (p.name == "Basis") return sayBasis(script, word);
  if (p.name == "ReverseOrientation" && v.size() == 1) {
    if (v[0] != 0) script.say("ReverseOrientation");
    return true;
  }
  if (p.name != "PixelFilterName" && p.name != "PixelFilterWidth") return false;
  const Param *name = findParam(r.params, "PixelFilterName"), *width = findParam(r.params, "PixelFilterWidth");
  if (!name || name->strings.empty() || (width && values(*width).size() != 2)) return false;
  if (&p == name) script.say("PixelFilter", {string(word), numbers(width ? values(*width) : std::vector<float>{2, 2})});
  return true;
}

}  // namespace

Translation riValues(const Request& r) {
  Script script(r);
  std::vector<Note> notes;
  for (const Param& p : r.params)
    if (!say(script, r, p)) {
      const std::string key = fmt::format("{} Ri:{}", r.name, p.name);
      notes.push_back({key, fmt::format("{} \"Ri:{}\" has no effect here", r.name, p.name), r.where, Severity::Warning,
                       r.name == "Option" ? "rib-unknown-option" : "rib-unknown-attribute"});
    }
  return {script.list(), std::move(notes)};
}

}  // namespace tomales::rib

#include "reyes/rib/option_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "reyes/base/deep_stack.h"
#include "reyes/base/search_path.h"
#include "reyes/rib/handlers.h"

namespace tomales::rib {
namespace {

/// Sets the search path of a category, before and after the map of folders.
void setMappedPath(GraphicsState& s, const Request& r, const std::string& category, const std::string& path) {
  Globals& g = s.globals;
  // Relative folders also count from the scene's own folder, so that a scene renders from any folder.
  const std::string inPlace = alsoWithin(mappedPath(path, g.dirMap), r.where.folder().string());
  if (std::max(path.size(), inPlace.size()) > kLongestSearchPath)
    return s.warn(r, "rib-option",
                  fmt::format("the search path \"{}\" would be longer than {} bytes; the option is left as it was",
                              category.substr(0, 80), kLongestSearchPath));
  g.unmappedPaths[category] = path;
  g.options.searchPaths[category] = inPlace;
}

int clampedInteger(GraphicsState& s, const Request& r, float value, float least, float most) {
  return static_cast<int>(clamped(s, r, value, least, most));
}

/// The option is read by its name in Options::user.
bool readByName(GraphicsState&, const Request&, const Param&) { return true; }
/// The name is in the table only for its type.
bool withoutEffect(GraphicsState&, const Request&, const Param&) { return false; }

bool bucketSize(GraphicsState& s, const Request& r, const Param& p) {
  if (p.ints.size() != 2) return false;
  s.globals.options.bucketWidth = clampedInteger(s, r, static_cast<float>(p.ints[0]), 1, 4096);
  s.globals.options.bucketHeight = clampedInteger(s, r, static_cast<float>(p.ints[1]), 1, 4096);
  return true;
}

bool gridSize(GraphicsState& s, const Request& r, const Param& p) {
  if (p.ints.size() != 1) return false;
  s.globals.options.gridSize = clampedInteger(s, r, static_cast<float>(p.ints[0]), 1, 65536);
  return true;
}

template <vec3 Options::*kThreshold>
bool threshold(GraphicsState& s, const Request&, const Param& p) {
  if (p.floats.size() != 3) return false;
  s.globals.options.*kThreshold = {p.floats[0], p.floats[1], p.floats[2]};
  return true;
}

bool bucketOrder(GraphicsState& s, const Request& r, const Param& p) {
  static constexpr std::string_view kOrders[] = {"horizontal", "vertical", "zigzag-x", "zigzag-y",
                                                 "spacefill",  "spiral",   "random"};
  if (p.strings.size() != 1) return false;
  const std::string& asked = p.strings[0];
  std::string& order = s.globals.options.bucketOrder;
  if (std::find(std::begin(kOrders), std::end(kOrders), asked) != std::end(kOrders))
    order = asked;
  else if (asked == "circle")  // the word of RenderMan for Maya
    order = "spiral";
  else
    s.warn(r, "rib-bucket-order", "no bucket order \"" + asked + "\"; \"" + order + "\" is used");
  return true;
}

bool maxDepth(GraphicsState& s, const Request& r, const Param& p) {
  s.globals.options.maxRayDepth = clampedInteger(s, r, p.number(10), 0, kMostBounces);
  return true;
}

bool shutterOffset(GraphicsState& s, const Request&, const Param& p) {
  s.globals.options.shutterOffset = p.number(0);
  return true;
}

/// BMRT's name of the option. Tomales' own name takes precedence, in any order.
bool prmanSpecular(GraphicsState& s, const Request&, const Param& p) {
  const auto [it, isNew] = s.globals.options.user.try_emplace("shade:specular");
  if (isNew || it->second.name == p.name) it->second = wordParam(p.name, p.number(0) != 0 ? "prman" : "rispec");
  return true;
}

bool searchPath(GraphicsState& s, const Request& r, const Param& p) {
  if (p.strings.empty()) return false;
  Globals& g = s.globals;
  if (p.name == "dirmap") {
    g.dirMap = readDirMap(p.strings);
    for (const auto& [category, path] : std::map(g.unmappedPaths)) setMappedPath(s, r, category, path);
    return true;
  }
  std::string unset;
  setMappedPath(s, r, p.name, expandSearchPath(p.strings[0], g.unmappedPaths[p.name], unset));
  if (!unset.empty())
    s.warn(r, "rib-variable", "the environment has no " + unset + "; it stands for nothing in the search path");
  return true;
}

constexpr NamedOption kRows[] = {
    {"bucket:order", "string", bucketOrder},
    {"limits:bucketsize", "int[2]", bucketSize},
    {"limits:gridsize", "int", gridSize},
    {"limits:othreshold", "color", threshold<&Options::opaqueThreshold>},
    {"limits:zthreshold", "color", threshold<&Options::depthThreshold>},
    {"limits:texturememory", "int", readByName},
    {"limits:geocachememory", "int", readByName},
    {"shade:specular", "string", readByName},
    {"shade:arealight", "string", readByName},
    {"render:prmanspecular", "int", prmanSpecular},
    {"texture:width", "float", readByName},
    {"texture:filter", "string", readByName},
    {"shadow:bias", "float", readByName},
    {"shadow:bias0", "float", readByName},
    {"shadow:bias1", "float", readByName},
    {"shutter:offset", "float", shutterOffset},
    {"trace:maxdepth", "int", maxDepth},
    {"trace:lightcut", "int", readByName},
    {"trace:openings", "int", readByName},
    {"ribparse:varsubst", "string", readByName},
    {"searchpath:archive", "string", searchPath},
    {"searchpath:shader", "string", searchPath},
    {"searchpath:texture", "string", searchPath},
    {"searchpath:display", "string", searchPath},
    {"searchpath:procedural", "string", searchPath},
    {"searchpath:resource", "string", searchPath},
    {"searchpath:texturecache", "string", searchPath},
    {"searchpath:dirmap", "string", searchPath},
    // Known, but without effect (refusals.cpp)
    {"bucket:orderorigin", "int[2]", withoutEffect},
    {"limits:eyesplits", "int", withoutEffect},
    {"limits:threads", "int", withoutEffect},
    {"limits:brickmemory", "int", withoutEffect},
    {"limits:maxshadinggrids", "int", withoutEffect},
    {"statistics:endofframe", "int", withoutEffect},
    {"statistics:filename", "string", withoutEffect},
    {"statistics:xmlfilename", "string", withoutEffect},
};

}  // namespace

std::span<const NamedOption> namedOptions() { return kRows; }

bool setNamedOption(GraphicsState& s, const Request& r, const std::string& name, const Param& p) {
  if (name.starts_with("user:")) return true;                       // for shaders
  if (name.starts_with("searchpath:")) return searchPath(s, r, p);  // files of any kind have one
  const auto row = std::find_if(std::begin(kRows), std::end(kRows), [&](const auto& o) { return o.name == name; });
  return row != std::end(kRows) && row->set(s, r, p);
}

}  // namespace tomales::rib

// Resource "attributes": named copies of the attributes, restored as a whole or in part.
#include <fmt/format.h>

#include "reyes/base/search_path.h"
#include "reyes/rib/handlers.h"

namespace tomales::rib {
namespace {

using Restore = void (*)(Scope& to, const Scope& from);

// A solid is a block of requests, not an attribute, so the enclosing solid stays.
void restoreAll(Scope& to, const Scope& from) {
  const int solid = to.solid, solidBlock = to.solidBlock;
  to = from;
  to.solid = solid;
  to.solidBlock = solidBlock;
}

void restoreTransform(Scope& to, const Scope& from) {
  to.ctm = from.ctm;
  to.coordinateSystems = from.coordinateSystems;
}

void restoreShading(Scope& to, const Scope& from) {
  Attributes& a = to.edit();
  const Attributes& b = *from.attributes;
  a.color = b.color;
  a.opacity = b.opacity;
  a.surface = b.surface;
  a.lights = b.lights;
  a.areaLight = b.areaLight;
  a.interior = b.interior;
  a.exterior = b.exterior;
  a.atmosphere = b.atmosphere;
  a.shadingRate = b.shadingRate;
  a.interpolation = b.interpolation;
  a.indirect = b.indirect;
  a.trace = b.trace;
  a.irradianceMaxError = b.irradianceMaxError;
  a.irradianceMaxPixelDist = b.irradianceMaxPixelDist;
  to.shadingRate = from.shadingRate;
  to.relativeShadingRate = from.relativeShadingRate;
  to.lightsCastShadows = from.lightsCastShadows;
}

void restoreGeometryModification(Scope& to, const Scope& from) {
  Attributes& a = to.edit();
  const Attributes& b = *from.attributes;
  a.displacement = b.displacement;
  a.displacementBound = b.displacementBound;
  a.displacementBoundSpace = b.displacementBoundSpace;
  a.rasterOrient = b.rasterOrient;
  a.binaryDice = b.binaryDice;
}

void restoreGeometryDefinition(Scope& to, const Scope& from) {
  Attributes& a = to.edit();
  a.textureCoordinates = from.attributes->textureCoordinates;
  a.insideOut = from.attributes->insideOut;
  to.uBasis = from.uBasis;
  to.vBasis = from.vBasis;
  to.roundCurves = from.roundCurves;
}

void restoreHiding(Scope& to, const Scope& from) {
  Attributes& a = to.edit();
  a.matte = from.attributes->matte;
  a.sides = from.attributes->sides;
  a.visibility = from.attributes->visibility;
}

const std::unordered_map<std::string_view, Restore>& subsets() {
  static const std::unordered_map<std::string_view, Restore> table = {
      {"all", restoreAll},
      {"transform", restoreTransform},
      {"shading", restoreShading},
      {"geometrymodification", restoreGeometryModification},
      {"geometrydefinition", restoreGeometryDefinition},
      {"hiding", restoreHiding}};
  return table;
}

void restore(GraphicsState& s, const Request& r, const Scope& from) {
  std::string list = wordOf(r.params, "subset", "all");
  std::replace(list.begin(), list.end(), ',', ':');
  for (std::string subset : foldersOf(list)) {
    std::erase(subset, ' ');
    if (const auto it = subsets().find(subset); it != subsets().end())
      it->second(s.scope, from);
    else
      s.warn(r, "rib-resource", "there is no subset \"" + subset + "\"; ignored");
  }
}

void resource(GraphicsState& s, const Request& r) {
  const std::string &name = r.args[0].strings[0], operation = wordOf(r.params, "operation");
  auto& scopes = s.globals.resources;
  if (r.args[1].strings[0] != "attributes" || (operation != "save" && operation != "restore"))
    return s.warn(r, "rib-resource",
                  fmt::format("operation \"{}\" of a resource of type \"{}\" is not supported; ignored", operation,
                              r.args[1].strings[0]));
  if (operation == "save") {
    scopes.back()[name] = s.scope;
    return;
  }
  const auto scope = std::find_if(scopes.rbegin(), scopes.rend(), [&](const auto& m) { return m.contains(name); });
  if (scope == scopes.rend()) return s.warn(r, "rib-resource", "nothing is saved as \"" + name + "\"; ignored");
  restore(s, r, scope->at(name));
}

void begin(GraphicsState& s, const Request& r) {
  if (s.globals.resources.size() < GraphicsState::kDeepest)
    s.globals.resources.emplace_back();
  else
    s.warn(r, "rib-nesting", "too many open scopes of resources; ignored");
}

void end(GraphicsState& s, const Request& r) {
  if (s.globals.resources.size() > 1)
    s.globals.resources.pop_back();
  else
    s.warn(r, "rib-unbalanced", "without ResourceBegin, ignored");
}

}  // namespace

const HandlerTable& resourceHandlers() {
  static const HandlerTable table = {{"Resource", resource}, {"ResourceBegin", begin}, {"ResourceEnd", end}};
  return table;
}

}  // namespace tomales::rib

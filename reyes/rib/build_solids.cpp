// SolidBegin ... SolidEnd (RISpec 3.2 section 5.9).
#include <fmt/format.h>

#include "reyes/rib/closed_surface.h"
#include "reyes/rib/handlers.h"

namespace tomales::rib {
namespace {

// A limit, because every sample walks up the blocks that it enters and leaves.
constexpr int kDeepestSolid = 100;

std::optional<SolidOperation> operationOf(const std::string& name) {
  static const std::unordered_map<std::string_view, SolidOperation> table = {
      {"primitive", SolidOperation::Primitive},
      {"union", SolidOperation::Union},
      {"intersection", SolidOperation::Intersection},
      {"difference", SolidOperation::Difference}};
  const auto it = table.find(name);
  return it == table.end() ? std::nullopt : std::optional(it->second);
}

Solid& openSolid(GraphicsState& s) { return s.world->solids[static_cast<size_t>(s.scope.solid)]; }

/// The objects of the primitive that is open are the last that were made.
std::span<Object> objectsOfPrimitive(GraphicsState& s) {
  std::vector<Object>& all = s.world->objects;
  size_t first = all.size();
  while (first > 0 && all[first - 1].solid == s.scope.solid && all[first - 1].solidBlock == s.scope.solidBlock) --first;
  return {all.data() + first, all.size() - first};
}

}  // namespace

void beginSolid(GraphicsState& s, const Request& r) {
  if (!s.world) return s.warn(r, "rib-solid", "outside of WorldBegin and WorldEnd; only its attributes count");
  const std::string& name = r.args[0].strings[0];
  const std::optional<SolidOperation> operation = operationOf(name);
  if (!operation) s.warn(r, "rib-solid", "unknown operation \"" + name + "\"; union is used");
  if (s.scope.solid >= 0 && openSolid(s).operation(s.scope.solidBlock) == SolidOperation::Primitive)
    return s.warn(r, "rib-solid", "inside a primitive; what it holds is part of the surface of that");
  if (s.scope.solid >= 0 && openSolid(s).depth(s.scope.solidBlock) >= kDeepestSolid)
    return s.warnOnce(
        "solids", r, "rib-nesting",
        fmt::format("SolidBegin: more than {} solids within solids; what it holds is part of the one around it",
                    kDeepestSolid));
  if (s.scope.solid < 0) {
    s.scope.solid = static_cast<int>(s.world->solids.size());
    s.world->solids.emplace_back();
  }
  s.scope.solidBlock = openSolid(s).add(operation.value_or(SolidOperation::Union), s.scope.solidBlock);
}

void endSolid(GraphicsState& s, const Request& r) {
  if (!s.world || s.scope.solid < 0 || openSolid(s).operation(s.scope.solidBlock) != SolidOperation::Primitive) return;
  const std::span<Object> objects = objectsOfPrimitive(s);
  findTurned(objects);
  if (const Object* open = findOpenEdge(objects))
    s.log.report(Severity::Warning, "rib-solid-open", open->where,
                 objectName(*open) + ": the primitive of a solid that ends at " + r.where.text() +
                     " is not closed: it has an edge that nothing joins; where it is seen through, the solid is wrong");
}

void placeInSolid(GraphicsState& s, Object& object) {
  if (s.scope.solid < 0) return;
  object.solid = s.scope.solid;
  object.solidBlock = s.scope.solidBlock;
  if (openSolid(s).operation(object.solidBlock) == SolidOperation::Primitive) return;
  s.log.report(
      Severity::Warning, "rib-solid", object.where,
      objectName(object) + ": in a solid operation, but not in SolidBegin \"primitive\"; it is a primitive of its own");
  object.solidBlock = openSolid(s).add(SolidOperation::Primitive, s.scope.solidBlock);
}

}  // namespace tomales::rib

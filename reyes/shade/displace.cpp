// Displacement: the shader of a grid's object runs over all its vertices.
#include <fmt/format.h>

#include "reyes/shade/batch.h"
#include "reyes/shade/system.h"

namespace tomales {
namespace {

/// Differences along the lattice: a displacement shader sees no better derivatives than its grid has. `d` is the change of the
/// parameter `of` over a micropolygon; 1 where it does not change along this direction, as at points that are shaded.
void derivatives(const Grid& g, const Stencil& stencil, int direction, const float* of, float* d, TmVec3 dP) {
  for (int i = 0; i < g.vertexCount(); ++i) {
    const float step = stencil.step(direction, of, i);
    d[i] = step != 0 ? step : 1.0f;
    set(dP, i, vec3(stencil.step(direction, g.P(0, 0), i), stencil.step(direction, g.P(0, 1), i), stencil.step(direction, g.P(0, 2), i)) / d[i]);
  }
}

/// Applies P - before to the later motion keys, turned as the object turns; returns the longest displacement.
float moveLaterKeys(Grid& g, TmConstVec3 before) {
  float longest2 = 0;
  for (int i = 0; i < g.vertexCount(); ++i) {
    const vec3 offset = g.position(0, i) - get(before, i);
    longest2 = std::max(longest2, dot(offset, offset));
    for (int key = 1; key < g.keyCount; ++key) {
      const vec3 turned = g.turns.empty() ? offset : g.turns[static_cast<size_t>(key)] * offset;
      for (int axis = 0; axis < 3; ++axis) g.P(key, axis)[i] += turned[axis];
    }
  }
  return std::sqrt(longest2);
}

void checkBound(const BoundScene& scene, const Object& object, float longest) {
  if (longest <= object.displacementBound * 1.001f) return;
  const Attributes& a = *object.attributes;
  const bool given = a.displacementBound > 0 && object.displacementBound > 0;
  const float needed = given ? longest * a.displacementBound / object.displacementBound : longest;
  const std::string space = given ? a.displacementBoundSpace : "camera";
  scene.log.report(Severity::Warning, "displacement-bound", object.where,
                   fmt::format("{}: displaced by more than its bound allows; parts may be cut off: Attribute "
                               "\"displacementbound\" needs \"sphere\" {:.4g} or more in \"{}\" space",
                               objectName(object), needed, space));
}

/// Undoes what is not finite, so that one bad vertex does not tear the mesh to infinity.
void repair(Batch& batch, Grid& g, TmConstVec3 P, TmConstVec3 N, bool all) {
  bool bad = false;
  for (int i = 0; i < g.vertexCount(); ++i) {
    const bool finite = isFinite(g.position(0, i)) && isFinite(g.normal(i));
    bad = bad || !finite;
    if (finite && !all) continue;
    set(batch.tm.P, i, get(P, i)), set(batch.tm.N, i, get(N, i));
  }
  if (bad && !all)
    batch.report(Severity::Warning, "shader-not-finite",
                 "moved points to NaN or infinity; they stay where they were");
}

}  // namespace

void Batch::setGrid(Grid& g, const BoundShader& shader, const std::vector<Override>& overrides) {
  grid = &g;
  const int n = g.vertexCount();
  setCommon(n, shader, overrides, [&](int offset) { return g.primvar(offset); });
  tm.P = {g.P(0, 0), g.P(0, 1), g.P(0, 2)};
  tm.N = {g.N(0), g.N(1), g.N(2)};
  tm.u = g.u(), tm.v = g.v();
  const TmVec3 Ng = arena.vec3(n), I = arena.vec3(n), dPdu = arena.vec3(n), dPdv = arena.vec3(n);
  calculateNormals(g, scene.scene.objects[static_cast<size_t>(g.object)].flipsNormal, Ng.x, Ng.y, Ng.z);
  stencil = stencilOf(g, arena);
  float *s = arena.floats(n), *t = arena.floats(n), *du = arena.floats(n), *dv = arena.floats(n);
  const auto& corners = group.group->attributes->textureCoordinates;
  derivatives(g, stencil, 0, g.u(), du, dPdu);
  derivatives(g, stencil, 1, g.v(), dv, dPdv);
  for (int i = 0; i < n; ++i) {
    set(I, i, scene.camera.incident(g.position(0, i)));
    const float u = g.u()[i], v = g.v()[i];
    const vec2 st = glm::mix(glm::mix(corners[0], corners[1], u), glm::mix(corners[2], corners[3], u), v);
    s[i] = st.x, t[i] = st.y;
  }
  tm.Ng = view(Ng), tm.I = view(I), tm.dPdu = view(dPdu), tm.dPdv = view(dPdv);
  tm.s = group.sOffset < 0 ? s : g.primvar(group.sOffset);
  tm.t = group.tOffset < 0 ? t : g.primvar(group.tOffset);
  tm.du = du, tm.dv = dv;
  tm.dPdtime = constant(vec3(0));
}

void ShadingSystem::displace(Grid& grid) const {
  const BoundScene& scene = *impl_;
  const Object& object = scene.scene.objects[static_cast<size_t>(grid.object)];
  const BoundGroup& group = scene.groups[static_cast<size_t>(object.group)];
  if (!group.displacement) return;

  ArenaLease arena;
  const ShadeContext context;
  Batch batch(scene, group, context, *arena);
  batch.setGrid(grid, *group.displacement, group.displacementOverrides);
  const int n = grid.vertexCount();
  const TmVec3 P = (*arena).vec3(n), N = (*arena).vec3(n);
  for (int i = 0; i < n; ++i) set(P, i, grid.position(0, i)), set(N, i, grid.normal(i));

  const ShaderTimer timer(scene.stats, *group.displacement, n);
  const bool finished = batch.run(*group.displacement, batch.tm);
  batch.running = group.displacement.get();
  repair(batch, grid, view(P), view(N), !finished);
  grid.displaced = true;
  checkBound(scene, object, moveLaterKeys(grid, view(P)));
}

}  // namespace tomales

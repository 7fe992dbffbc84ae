// Displacement: the shader of a grid's object runs over all its vertices.
#include <fmt/format.h>

#include "reyes/shade/batch.h"
#include "reyes/shade/illuminate.h"
#include "reyes/shade/system.h"

namespace tomales {
namespace {

/// Takes differences along the lattice: the derivatives of a displacement shader are as accurate as its grid. `d` is
/// the change of the parameter `of` over a micropolygon, or 1 where that is 0 along this direction, as at shaded
/// points. This is Stencil::step, written for vectors.
TOMALES_HOT void derivatives(int n, const Stencil& stencil, int direction, const float* of, TmConstVec3 P,
                             float* __restrict d, TmVec3 dP) {
  const int32_t *lo = stencil.lo[direction], *hi = stencil.hi[direction];
  const auto next = static_cast<float>(stencil.next[direction]);
  float* __restrict x = dP.x, * __restrict y = dP.y, * __restrict z = dP.z;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const int a = lo[i], b = hi[i];
    const auto span = static_cast<float>(b - a);
    const float step = (of[b] - of[a]) * next / span, by = step != 0 ? step : 1.0f;
    d[i] = by;
    x[i] = (P.x[b] - P.x[a]) * next / span / by;
    y[i] = (P.y[b] - P.y[a]) * next / span / by;
    z[i] = (P.z[b] - P.z[a]) * next / span / by;
  }
}

/// Applies Attributes::textureAt to all vertices.
TOMALES_HOT void textureCoordinates(int n, const std::array<vec2, 4>& corners, const float* u, const float* v,
                                    float* __restrict s, float* __restrict t) {
  const auto mix = [](float a, float b, float at) { return a * (1.0f - at) + b * at; };
  const vec2 c0 = corners[0], c1 = corners[1], c2 = corners[2], c3 = corners[3];
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    s[i] = mix(mix(c0.x, c1.x, u[i]), mix(c2.x, c3.x, u[i]), v[i]);
    t[i] = mix(mix(c0.y, c1.y, u[i]), mix(c2.y, c3.y, u[i]), v[i]);
  }
}

/// Returns the longest distance that a vertex has moved.
TOMALES_HOT float longestWay(int n, TmConstVec3 from, TmConstVec3 to) {
  float longest2[kLanes] = {};
  for (int first = 0; first < n; first += kLanes)  // arrays are padded
    for (int k = 0; k < kLanes; ++k) {
      const int i = first + k;
      const float x = to.x[i] - from.x[i], y = to.y[i] - from.y[i], z = to.z[i] - from.z[i],
                  length2 = x * x + y * y + z * z;
      longest2[k] = (i < n) & (longest2[k] < length2) ? length2 : longest2[k];
    }
  return std::sqrt(*std::max_element(longest2, longest2 + kLanes));
}

/// Applies the displacement P - before to the later motion keys, turned as the object turns. Returns the longest
/// displacement.
float moveLaterKeys(Grid& g, TmConstVec3 before) {
  for (int key = 1; key < g.keyCount; ++key)
    for (int i = 0; i < g.vertexCount(); ++i) {
      const vec3 offset = g.position(0, i) - get(before, i),
                 turned = g.turns.empty() ? offset : g.turns[static_cast<size_t>(key)] * offset;
      for (int axis = 0; axis < 3; ++axis) g.P(key, axis)[i] += turned[axis];
    }
  return longestWay(g.vertexCount(), before, {g.P(0, 0), g.P(0, 1), g.P(0, 2)});
}

void checkBound(const BoundScene& scene, const Object& object, float longest) {
  if (longest <= object.displacementBound * 1.001f) return;
  const Attributes& a = *object.attributes;
  const bool given = a.displacementBound > 0 && object.displacementBound > 0;
  const float needed = given ? longest * a.displacementBound / object.displacementBound : longest;
  const std::string space = given ? a.displacementBoundSpace : "camera";
  scene.log.report(Severity::Warning, "displacement-bound", object.where,
                   fmt::format("{}: displaced by more than its bound allows; parts may be cut off: Attribute "
                               "\"displacementbound\" needs \"sphere\" {:.4g} or more in \"{}\" space{}",
                               objectName(object), needed, space,
                               object.attributes->name.empty() ? "" : ", and other parts of that name may need more"),
                   objectName(object));
}

/// Undoes displacements that are not finite, so that one bad vertex does not tear the mesh to infinity.
void repair(Batch& batch, Grid& g, TmConstVec3 P, TmConstVec3 N, bool all) {
  const int n = g.vertexCount();
  if (!all && allFinite(n, {g.P(0, 0), g.P(0, 1), g.P(0, 2)}) && allFinite(n, {g.N(0), g.N(1), g.N(2)})) return;
  for (int i = 0; i < n; ++i) {
    if (!all && isFinite(g.position(0, i)) && isFinite(g.normal(i))) continue;
    set(batch.tm.P, i, get(P, i));
    set(batch.tm.N, i, get(N, i));
  }
  if (!all)
    batch.report(Severity::Warning, "shader-not-finite", "moved points to NaN or infinity; they stay where they were");
}

}  // namespace

void Batch::setGrid(Grid& g, const BoundShader& shader) {
  grid = &g;
  const int n = g.vertexCount();
  setCommon(n, shader);
  setVariables();
  for (const Override& o : group.displacementOutputs) {
    TmValue& value = params_[static_cast<size_t>(o.param)];
    for (int k = 0; k < o.width; ++k) value.c[k] = g.primvar(o.primvarOffset + k);
    value.step = 1;
  }
  tm.P = {g.P(0, 0), g.P(0, 1), g.P(0, 2)};
  tm.N = {g.N(0), g.N(1), g.N(2)};
  tm.u = g.u();
  tm.v = g.v();
  const TmVec3 Ng = arena.vec3(n), I = arena.vec3(n), dPdu = arena.vec3(n), dPdv = arena.vec3(n);
  calculateNormals(g, scene.scene.objects[static_cast<size_t>(g.object)].flipsNormal, Ng.x, Ng.y, Ng.z);
  stencil = stencilOf(g, arena);
  float *s = arena.floats(n), *t = arena.floats(n), *du = arena.floats(n), *dv = arena.floats(n);
  const TmConstVec3 P = view(tm.P);
  derivatives(n, stencil, 0, g.u(), P, du, dPdu);
  derivatives(n, stencil, 1, g.v(), P, dv, dPdv);
  textureCoordinates(n, group.group->attributes->textureCoordinates, g.u(), g.v(), s, t);
  // This is Camera::incident, an array at a time.
  const bool perspective = scene.camera.perspective();
  for (const auto& [to, from, parallel] :
       {std::tuple(I.x, P.x, 0.0f), std::tuple(I.y, P.y, 0.0f), std::tuple(I.z, P.z, 1.0f)}) {
    if (perspective)
      std::copy_n(from, n, to);
    else
      std::fill_n(to, n, parallel);
  }
  tm.Ng = view(Ng);
  tm.I = view(I);
  tm.dPdu = view(dPdu);
  tm.dPdv = view(dPdv);
  tm.s = group.sOffset < 0 ? s : g.primvar(group.sOffset);
  tm.t = group.tOffset < 0 ? t : g.primvar(group.tOffset);
  tm.du = du;
  tm.dv = dv;
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
  batch.setGrid(grid, *group.displacement);
  const int n = grid.vertexCount();
  const TmVec3 P = (*arena).vec3(n), N = (*arena).vec3(n);
  for (const auto& [to, from] :
       {std::pair(P.x, grid.P(0, 0)), std::pair(P.y, grid.P(0, 1)), std::pair(P.z, grid.P(0, 2)),
        std::pair(N.x, grid.N(0)), std::pair(N.y, grid.N(1)), std::pair(N.z, grid.N(2))})
    std::copy_n(from, n, to);

  const ShaderTimer timer(scene.stats, *group.displacement, n);
  const bool finished = batch.run(*group.displacement, batch.tm);
  batch.running = group.displacement.get();
  repair(batch, grid, view(P), view(N), !finished);
  grid.displaced = true;
  checkBound(scene, object, moveLaterKeys(grid, view(P)));
}

}  // namespace tomales

#include "reyes/base/rng.h"
#include "reyes/dice/evaluated.h"

namespace tomales {
namespace {

/// In the order of glm's product, so that one point is moved to the same bits.
TOMALES_HOT void transformAffine(const mat4& m, int n, Triple<const float> from, Triple<float> to) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const float x = from.x[i], y = from.y[i], z = from.z[i];
    to.x[i] = (m[0][0] * x + m[1][0] * y) + (m[2][0] * z + m[3][0]);
    to.y[i] = (m[0][1] * x + m[1][1] * y) + (m[2][1] * z + m[3][1]);
    to.z[i] = (m[0][2] * x + m[1][2] * y) + (m[2][2] * z + m[3][2]);
  }
}

void transformPoints(const mat4& m, int n, Triple<const float> from, Triple<float> to) {
  if (m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1) return transformAffine(m, n, from, to);
  for (int i = 0; i < n; ++i) {
    const vec3 p = transformPoint(m, {from.x[i], from.y[i], from.z[i]});
    to.x[i] = p.x, to.y[i] = p.y, to.z[i] = p.z;
  }
}

TOMALES_HOT void transformDirections(const mat3& m, int n, Triple<const float> from, Triple<float> to) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const float x = from.x[i], y = from.y[i], z = from.z[i];
    to.x[i] = m[0][0] * x + m[1][0] * y + m[2][0] * z;
    to.y[i] = m[0][1] * x + m[1][1] * y + m[2][1] * z;
    to.z[i] = m[0][2] * x + m[1][2] * y + m[2][2] * z;
  }
}

uint32_t nameOf(uint32_t object, uint32_t patch, const UvRect& r, int nu, int nv) {
  const auto bits = [](float f) { return __builtin_bit_cast(uint32_t, f); };
  return hashCombine(object, patch, bits(r.u0), bits(r.u1), bits(r.v0), bits(r.v1),
                     static_cast<uint32_t>(nu), static_cast<uint32_t>(nv));
}

uint8_t openEdgesOf(const PatchInfo& info, const UvRect& r) {
  const int touched = (r.u0 <= 0 ? kEdgeU0 : 0) | (r.u1 >= 1 ? kEdgeU1 : 0) | (r.v0 <= 0 ? kEdgeV0 : 0) | (r.v1 >= 1 ? kEdgeV1 : 0);
  return static_cast<uint8_t>(touched & info.openEdges);
}

/// Each cell with some of its surroundings: the hider asks for points a little way off a cell (hide/trim.cpp).
std::vector<Kept> keptOfCells(const Prim& prim, const Grid& g) {
  if (prim.kept(g.patch, g.rect) == Kept::All) return {};
  constexpr float kMargin = 0.25f;
  std::vector<Kept> out(static_cast<size_t>(g.cellCount()));
  for (int cell = 0; cell < g.cellCount(); ++cell) {
    const vec2 lo = g.onPatch(cell, vec2(-kMargin)), hi = g.onPatch(cell, vec2(1 + kMargin));
    out[static_cast<size_t>(cell)] = prim.kept(g.patch, {lo.x, hi.x, lo.y, hi.y});
  }
  return out;
}

}  // namespace

Grid dice(const Scene& scene, int object, uint32_t patch, const UvRect& rect, int nu, int nv, int keys, Pool* pool) {
  const Object& o = scene.objects[static_cast<size_t>(object)];
  const std::vector<float> times(o.keyTimes.begin(), o.keyTimes.begin() + keys);
  return dice(scene, object, patch, rect, nu, nv, {times, o.cameraFromObject}, pool);
}

Grid dice(const Scene& scene, int object, uint32_t patch, const UvRect& rect, int nu, int nv, const DiceKeys& keys,
          Pool* pool) {
  const Object& o = scene.objects[static_cast<size_t>(object)];
  const int keyCount = static_cast<int>(keys.times.size());
  const Prim& prim = o.shape();
  int floats = 0;
  for (const Primvar& p : prim.primvars()) floats += p.width;

  Grid g;
  g.object = object, g.patch = patch, g.rect = rect;
  g.allocate(nu, nv, keyCount, floats, pool);
  g.openEdges = openEdgesOf(prim.info(patch), rect);
  g.name = nameOf(o.name, patch, rect, nu, nv);
  g.kept = keptOfCells(prim, g);

  const int n = g.vertexCount();
  static thread_local AlignedVector<float> u, v;
  u.resize(static_cast<size_t>(g.stride())), v.resize(u.size());
  // The last vertex is the rectangle's own number, so that neighbours evaluate the same one.
  const auto at = [](float a, float b, int i, int count) {
    return i == count ? b : a + (b - a) * (static_cast<float>(i) / static_cast<float>(count));
  };
  for (int i = 0; i <= nu; ++i) u[static_cast<size_t>(i)] = at(rect.u0, rect.u1, i, nu);
  for (int j = 0; j <= nv; ++j) {
    const int first = j * (nu + 1);
    if (j > 0) std::copy_n(u.data(), nu + 1, u.data() + first);
    std::fill_n(v.data() + first, nu + 1, at(rect.v0, rect.v1, j, nv));
  }

  const bool whole = rect.u0 == 0 && rect.u1 == 1 && rect.v0 == 0 && rect.v1 == 1;
  const auto vertices = [&](const Prim& shape, SurfacePoints out) {
    if (whole)
      shape.evaluateLattice(patch, nu, nv, u.data(), v.data(), out);
    else
      shape.evaluate(patch, n, u.data(), v.data(), out);
  };
  Evaluated e(n);
  for (int key = 0; key < keyCount; ++key) {
    const float time = keys.times[static_cast<size_t>(key)];
    const mat4 m = keys.currentFromObject.at(time);
    if (keyCount > 1) g.turns.push_back(mat3(m) * glm::inverse(mat3(keys.currentFromObject.at(keys.times.front()))));
    evaluateAt(o, time, n, e, vertices);
    transformPoints(m, n, e.triple(0), {g.P(key, 0), g.P(key, 1), g.P(key, 2)});
    if (key == 0) {
      const mat3 normals = normalMatrix(o, m);
      transformDirections(normals, n, e.triple(9), {g.N(0), g.N(1), g.N(2)});
      int offset = 0;
      for (size_t k = 0; k < prim.primvars().size(); ++k) {
        const Primvar& p = prim.primvars()[k];
        prim.interpolate(patch, static_cast<int>(k), n, u.data(), v.data(), g.primvar(offset), g.stride());
        transformPrimvar(p, m, normals, n, g.primvar(offset), g.stride());
        offset += p.width;
      }
    }
  }
  prim.surfaceParameters(patch, n, u.data(), v.data(), g.u(), g.v());

  // A normal that the user gives is the shading normal (RISpec 5.2); the geometric one is still measured from P.
  if (const int offset = offsetOf(prim.primvars(), "N"); offset >= 0)
    for (int axis = 0; axis < 3; ++axis) std::copy_n(g.primvar(offset + axis), n, g.N(axis));
  return g;
}

}  // namespace tomales

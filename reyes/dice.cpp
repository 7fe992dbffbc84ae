#include "reyes/dice.h"

#include "reyes/base/rng.h"

namespace tomales {
namespace {

/// Three arrays.
template <class T>
struct Triple {
  T *x, *y, *z;
};

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

/// Object-space results of Prim::evaluate for n points; memory is kept by the thread.
class Evaluated {
 public:
  explicit Evaluated(int n) : stride_(n == 1 ? 1 : static_cast<size_t>(padded(n))) {
    if (n > 1) {
      many_.swap(spare());
      many_.resize(std::max(many_.size(), stride_ * 12));
    }
    data_ = n > 1 ? many_.data() : one_;
  }
  ~Evaluated() {
    if (many_.size() > spare().size()) many_.swap(spare());
  }
  Evaluated(const Evaluated&) = delete;
  /// From one of the points on.
  SurfacePoints view(int first = 0) {
    const auto a = [this, first](size_t i) { return data_ + i * stride_ + first; };
    return {a(0), a(1), a(2), a(3), a(4), a(5), a(6), a(7), a(8), a(9), a(10), a(11)};
  }
  vec3 get(size_t first, int i) const {
    const float* x = data_ + first * stride_ + i;
    return {x[0], x[stride_], x[2 * stride_]};
  }
  Triple<const float> triple(size_t first) const {
    const float* x = data_ + first * stride_;
    return {x, x + stride_, x + 2 * stride_};
  }
  void blend(const Evaluated& next, float t) {
    for (size_t i = 0; i < stride_ * 12; ++i) data_[i] = lerp(data_[i], next.data_[i], t);
  }

 private:
  /// Memory that a thread keeps from grid to grid.
  static AlignedVector<float>& spare() {
    static thread_local AlignedVector<float> memory;
    return memory;
  }

  size_t stride_;
  float one_[12] = {};
  AlignedVector<float> many_;
  float* data_;
};

/// A deforming object at `time`: linear between the two shapes around it. evaluate(prim, out) fills n points of `out`.
template <class Evaluate>
void evaluateAt(const Object& o, float time, int n, Evaluated& out, const Evaluate& evaluate) {
  size_t k = 0;
  while (k + 1 < o.shapeTimes.size() && o.shapeTimes[k + 1] <= time) ++k;
  evaluate(*o.shapes[k], out);
  if (k + 1 >= o.shapes.size() || time <= o.shapeTimes[k]) return;
  const float t = (time - o.shapeTimes[k]) / (o.shapeTimes[k + 1] - o.shapeTimes[k]);
  Evaluated next(n);
  evaluate(*o.shapes[k + 1], next);
  out.blend(next, t);
}

/// Normals by the cofactor matrix: right for any scale, and mirrored exactly when cross products of transformed
/// derivatives are, which Object::flipsNormal undoes.
mat3 normalMatrix(const Object& o, const mat4& m) {
  const mat3 a(m);
  const mat3 cofactor(cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1]));
  return o.flipsNormal ? -cofactor : cofactor;
}

/// Primitive variables given in object space arrive in current space.
void transformPrimvar(const Primvar& p, const mat4& m, const mat3& normals, int n, float* values, int stride) {
  const bool point = p.type == ValueType::Point, vector = p.type == ValueType::Vector, normal = p.type == ValueType::Normal;
  if (!point && !vector && !normal) return;
  for (int first = 0; first + 2 < p.width; first += 3)
    for (int i = 0; i < n; ++i) {
      float* x = values + first * stride + i;
      const vec3 in(x[0], x[stride], x[2 * stride]);
      const vec3 out = point ? transformPoint(m, in) : vector ? transformVector(m, in) : normals * in;
      x[0] = out.x, x[stride] = out.y, x[2 * stride] = out.z;
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
  const auto whole = [&](const PatchPiece& p) { return prim.kept(p.patch, p.rect) == Kept::All; };
  if (std::all_of(g.pieces.begin(), g.pieces.end(), whole)) return {};
  constexpr float kMargin = 0.25f;
  std::vector<Kept> out(static_cast<size_t>(g.cellNumbers()));
  for (int cell = 0; cell < g.cellNumbers(); ++cell) {
    const vec2 lo = g.onPatch(cell, vec2(-kMargin)), hi = g.onPatch(cell, vec2(1 + kMargin));
    out[static_cast<size_t>(cell)] = prim.kept(g.pieces[static_cast<size_t>(g.pieceOfCell(cell))].patch, {lo.x, hi.x, lo.y, hi.y});
  }
  return out;
}

bool isWhole(const UvRect& r) { return r.u0 == 0 && r.u1 == 1 && r.v0 == 0 && r.v1 == 1; }

/// Where a lattice of nu x nv over a rectangle lies on its patch, rows along u.
void latticeOver(const UvRect& rect, int nu, int nv, float* u, float* v) {
  // The last vertex is the rectangle's own number, so that neighbours evaluate the same one.
  const auto at = [](float a, float b, int i, int count) {
    return i == count ? b : a + (b - a) * (static_cast<float>(i) / static_cast<float>(count));
  };
  for (int i = 0; i <= nu; ++i) u[i] = at(rect.u0, rect.u1, i, nu);
  for (int j = 0; j <= nv; ++j) {
    const int first = j * (nu + 1);
    if (j > 0) std::copy_n(u, nu + 1, u + first);
    std::fill_n(v + first, nu + 1, at(rect.v0, rect.v1, j, nv));
  }
}

/// Offset of the primvar `name` among the group's floats, or -1.
int offsetOf(const std::vector<Primvar>& primvars, std::string_view name) {
  int offset = 0;
  for (const Primvar& p : primvars) {
    if (p.name == name) return offset;
    offset += p.width;
  }
  return -1;
}

}  // namespace

Grid dice(const Scene& scene, int object, uint32_t patch, const UvRect& rect, int nu, int nv, int keys) {
  const Object& o = scene.objects[static_cast<size_t>(object)];
  const std::vector<float> times(o.keyTimes.begin(), o.keyTimes.begin() + keys);
  return dice(scene, object, patch, rect, nu, nv, {times, o.cameraFromObject});
}

Grid dice(const Scene& scene, int object, uint32_t patch, const UvRect& rect, int nu, int nv, const DiceKeys& keys) {
  const PatchPiece piece{patch, rect};
  return dice(scene, object, {&piece, 1}, nu, nv, keys);
}

Grid dice(const Scene& scene, int object, std::span<const PatchPiece> pieces, int nu, int nv, const DiceKeys& keys, Pool* pool) {
  const Object& o = scene.objects[static_cast<size_t>(object)];
  const int keyCount = static_cast<int>(keys.times.size());
  const Prim& prim = o.shape();
  int floats = 0;
  for (const Primvar& p : prim.primvars()) floats += p.width;

  Grid g;
  g.object = object;
  g.pieces.clear();
  g.pieces.reserve(pieces.size());
  for (const PatchPiece& p : pieces)
    g.pieces.push_back({p, openEdgesOf(prim.info(p.patch), p.rect), nameOf(o.name, p.patch, p.rect, nu, nv)});
  g.allocate(nu, nv, keyCount, floats, pool);
  g.kept = keptOfCells(prim, g);

  const int n = g.vertexCount(), ofPiece = g.verticesOfPiece();
  static thread_local AlignedVector<float> u, v;
  u.resize(static_cast<size_t>(padded(ofPiece))), v.resize(u.size());
  UvRect laid{0, 0, 0, 0};  // u and v are for this
  /// f(piece, number of its first vertex), with u and v for the piece.
  const auto forPieces = [&](const auto& f) {
    int first = 0;
    for (const Grid::Piece& p : g.pieces) {
      if (p.rect.u0 != laid.u0 || p.rect.u1 != laid.u1 || p.rect.v0 != laid.v0 || p.rect.v1 != laid.v1)
        latticeOver(laid = p.rect, nu, nv, u.data(), v.data());
      f(p, first);
      first += ofPiece;
    }
  };
  const auto vertices = [&](const Prim& shape, Evaluated& out) {
    forPieces([&](const Grid::Piece& p, int first) {
      if (isWhole(p.rect))
        shape.evaluateLattice(p.patch, nu, nv, u.data(), v.data(), out.view(first));
      else
        shape.evaluate(p.patch, ofPiece, u.data(), v.data(), out.view(first));
    });
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
        forPieces([&](const Grid::Piece& piece, int first) {
          prim.interpolate(piece.patch, static_cast<int>(k), ofPiece, u.data(), v.data(), g.primvar(offset) + first, g.stride());
        });
        transformPrimvar(p, m, normals, n, g.primvar(offset), g.stride());
        offset += p.width;
      }
    }
  }
  forPieces([&](const Grid::Piece& p, int first) {
    prim.surfaceParameters(p.patch, ofPiece, u.data(), v.data(), g.u() + first, g.v() + first);
  });

  // A normal that the user gives is the shading normal (RISpec 5.2); the geometric one is still measured from P.
  if (const int offset = offsetOf(prim.primvars(), "N"); offset >= 0)
    for (int axis = 0; axis < 3; ++axis) std::copy_n(g.primvar(offset + axis), n, g.N(axis));
  return g;
}

TrueSurface surfaceAt(const Scene& scene, int object, uint32_t patch, float u, float v) {
  const Object& o = scene.objects[static_cast<size_t>(object)];
  const mat4& m = scene.groups[static_cast<size_t>(o.group)].cameraFromObject;
  Evaluated e(1);
  evaluateAt(o, o.keyTimes.front(), 1, e, [&](const Prim& shape, Evaluated& out) { shape.evaluate(patch, 1, &u, &v, out.view()); });
  return {transformPoint(m, e.get(0, 0)), transformVector(m, e.get(3, 0)), transformVector(m, e.get(6, 0)),
          normalMatrix(o, m) * e.get(9, 0)};
}

namespace {

/// The shader's parameters at a place of a patch, and how they run along it: patches of one mesh share a parameter square.
struct ShaderParameters {
  float u, v, perU, perV;

  ShaderParameters(const Prim& prim, uint32_t patch, float u0, float v0) {
    const float us[3] = {u0, u0 < 0.5f ? u0 + 0.5f : u0 - 0.5f, u0}, vs[3] = {v0, v0, v0 < 0.5f ? v0 + 0.5f : v0 - 0.5f};
    float su[3], sv[3];
    prim.surfaceParameters(patch, 3, us, vs, su, sv);
    const float dsu = (su[1] - su[0]) / (us[1] - us[0]), dsv = (sv[2] - sv[0]) / (vs[2] - vs[0]);
    u = su[0], v = sv[0], perU = dsu != 0 ? dsu : 1.0f, perV = dsv != 0 ? dsv : 1.0f;
  }
};

/// All primitive variables at one place, current space.
void primvarsAt(const Prim& prim, uint32_t patch, float u, float v, const mat4& m, const mat3& normals, AlignedVector<float>& out) {
  out.clear();
  for (size_t k = 0; k < prim.primvars().size(); ++k) {
    const Primvar& p = prim.primvars()[k];
    const size_t first = out.size();
    out.resize(first + static_cast<size_t>(p.width));
    prim.interpolate(patch, static_cast<int>(k), 1, &u, &v, out.data() + first, 1);
    transformPrimvar(p, m, normals, 1, out.data() + first, 1);
  }
}

vec3 tripleAt(const AlignedVector<float>& values, int offset) {
  const float* v = values.data() + offset;
  return {v[0], v[1], v[2]};
}

}  // namespace

void evaluatePoint(const Scene& scene, int object, uint32_t patch, float u, float v, ShadePoints& batch, int index) {
  const Object& o = scene.objects[static_cast<size_t>(object)];
  const Prim& prim = o.shape();
  const mat4& m = scene.groups[static_cast<size_t>(o.group)].cameraFromObject;
  const mat3 normals = normalMatrix(o, m);

  const TrueSurface surface = surfaceAt(scene, object, patch, u, v);
  const vec3 geometric = normalizeOr(surface.normal, vec3(0, 0, -1));
  batch.set3(kPx, index, surface.P);
  batch.set3(kNgx, index, geometric);
  batch.set3(kNx, index, geometric);

  const ShaderParameters shader(prim, patch, u, v);
  batch.set3(kDpduX, index, surface.dPdu / shader.perU);
  batch.set3(kDpdvX, index, surface.dPdv / shader.perV);
  batch.channel(kU)[index] = shader.u;
  batch.channel(kV)[index] = shader.v;
  batch.channel(kDu)[index] = 0;
  batch.channel(kDv)[index] = 0;
  batch.channel(kArea)[index] = 0;

  AlignedVector<float> values;
  primvarsAt(prim, patch, u, v, m, normals, values);
  for (int c = 0; c < static_cast<int>(values.size()); ++c) batch.primvar(c)[index] = values[static_cast<size_t>(c)];
  if (const int n = offsetOf(prim.primvars(), "N"); n >= 0) batch.set3(kNx, index, normalizeOr(tripleAt(values, n), geometric));
  const vec2 st = o.attributes->textureAt(shader.u, shader.v);
  const int s = offsetOf(prim.primvars(), "s"), t = offsetOf(prim.primvars(), "t");
  batch.channel(kS)[index] = s >= 0 ? batch.primvar(s)[index] : st.x;
  batch.channel(kT)[index] = t >= 0 ? batch.primvar(t)[index] : st.y;
}

void evaluateSteps(const Scene& scene, int object, uint32_t patch, float u, float v, float radius, ShadePoints& batch, int index) {
  constexpr float kWidest = 0.25f;  // of a patch: its end is never passed on both sides
  const Object& o = scene.objects[static_cast<size_t>(object)];
  const Prim& prim = o.shape();
  const mat4& m = scene.groups[static_cast<size_t>(o.group)].cameraFromObject;
  const mat3 normals = normalMatrix(o, m);
  const ShaderParameters here(prim, patch, u, v);
  const int N = offsetOf(prim.primvars(), "N"), s = offsetOf(prim.primvars(), "s"), t = offsetOf(prim.primvars(), "t");
  const auto normalAt = [&](float pu, float pv, const AlignedVector<float>& values) {
    return normalizeOr(N >= 0 ? tripleAt(values, N) : surfaceAt(scene, object, patch, pu, pv).normal, vec3(0));
  };
  AlignedVector<float> values, moved;
  primvarsAt(prim, patch, u, v, m, normals, values);
  const vec3 normal = normalAt(u, v, values);
  for (const bool alongV : {false, true}) {
    const float edge = glm::length(batch.get3(alongV ? kDpdvX : kDpduX, index)), per = std::abs(alongV ? here.perV : here.perU);
    const float patchStep = edge * per > 0 ? std::clamp(2 * radius / (edge * per), 1e-6f, kWidest) : kWidest;
    const float at = alongV ? v : u, sign = at + patchStep <= 1 ? 1.0f : -1.0f;
    const float pu = alongV ? u : u + sign * patchStep, pv = alongV ? v + sign * patchStep : v;
    primvarsAt(prim, patch, pu, pv, m, normals, moved);
    const auto put = [&](int value, float change) { batch.step(value, alongV)[index] = sign * change; };
    const vec3 turned = normalAt(pu, pv, moved) - normal;
    for (int axis = 0; axis < 3; ++axis) put(kStepN + axis, turned[axis]);
    for (int c = 0; c < static_cast<int>(values.size()); ++c) {
      const auto k = static_cast<size_t>(c);
      put(kStepPrimvars + c, moved[k] - values[k]);
    }
    const ShaderParameters there(prim, patch, pu, pv);
    const vec2 st = o.attributes->textureAt(there.u, there.v) - o.attributes->textureAt(here.u, here.v);
    put(kStepS, s >= 0 ? moved[static_cast<size_t>(s)] - values[static_cast<size_t>(s)] : st.x);
    put(kStepT, t >= 0 ? moved[static_cast<size_t>(t)] - values[static_cast<size_t>(t)] : st.y);
    batch.channel(alongV ? kDv : kDu)[index] = patchStep * per;
  }
}

}  // namespace tomales

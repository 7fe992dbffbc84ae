#include "reyes/base/rng.h"
#include "reyes/dice/evaluated.h"
#include "reyes/displacement_outputs.h"
#include "reyes/scattered.h"

namespace tomales {
namespace {

/// The sums are in the order of glm's product, so that a single point gets the same bits.
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
    to.x[i] = p.x;
    to.y[i] = p.y;
    to.z[i] = p.z;
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

uint32_t sampleKeyOf(uint32_t object, uint32_t patch, const UvRect& r, int nu, int nv) {
  const auto bits = [](float f) { return __builtin_bit_cast(uint32_t, f); };
  return hashCombine(object, patch, bits(r.u0), bits(r.u1), bits(r.v0), bits(r.v1), static_cast<uint32_t>(nu),
                     static_cast<uint32_t>(nv));
}

uint8_t openEdgesOf(const PatchInfo& info, const UvRect& r) {
  const int touched =
      (r.u0 <= 0 ? kEdgeU0 : 0) | (r.u1 >= 1 ? kEdgeU1 : 0) | (r.v0 <= 0 ? kEdgeV0 : 0) | (r.v1 >= 1 ? kEdgeV1 : 0);
  return static_cast<uint8_t>(touched & info.openEdges);
}

/// Returns the part of each cell, grown a little, that trim curves keep: the hider tests points slightly outside of a
/// cell (hide/trim.cpp).
std::vector<Kept> keptOfCells(const Prim& prim, const Grid& g) {
  const auto whole = [&](const PatchPiece& p) { return prim.kept(p.patch, p.rect) == Kept::All; };
  if (std::all_of(g.pieces.begin(), g.pieces.end(), whole)) return {};
  constexpr float kMargin = 0.25f;
  std::vector<Kept> out(static_cast<size_t>(g.cellNumbers()));
  for (int cell = 0; cell < g.cellNumbers(); ++cell) {
    const vec2 lo = g.onPatch(cell, vec2(-kMargin)), hi = g.onPatch(cell, vec2(1 + kMargin));
    out[static_cast<size_t>(cell)] =
        prim.kept(g.pieces[static_cast<size_t>(g.pieceOfCell(cell))].patch, {lo.x, hi.x, lo.y, hi.y});
  }
  return out;
}

bool isWhole(const UvRect& r) { return r.u0 == 0 && r.u1 == 1 && r.v0 == 0 && r.v1 == 1; }

/// Parameters of a lattice of nu x nv over a rectangle, in rows along u.
void latticeOver(const UvRect& rect, int nu, int nv, float* u, float* v) {
  // The last vertex takes the rectangle's own number, so that neighbours evaluate the same one.
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

/// Goes over the pieces of a grid with the parameters of their lattices. Pieces of the same rectangle, one after the
/// other, share them.
class PieceLattices {
 public:
  explicit PieceLattices(const Grid& g) : g_(g), u_(ofThread().u), v_(ofThread().v) {
    u_.resize(static_cast<size_t>(padded(g.verticesOfPiece())));
    v_.resize(u_.size());
  }

  /// Calls visit(piece, number of its first vertex, u, v).
  template <class Visit>
  void forEach(const Visit& visit) {
    int first = 0;
    for (const Grid::Piece& p : g_.pieces) {
      if (p.rect.u0 != laid_.u0 || p.rect.u1 != laid_.u1 || p.rect.v0 != laid_.v0 || p.rect.v1 != laid_.v1)
        latticeOver(laid_ = p.rect, g_.nu, g_.nv, u_.data(), v_.data());
      visit(p, first, u_.data(), v_.data());
      first += g_.verticesOfPiece();
    }
  }

 private:
  struct Parameters {
    AlignedVector<float> u, v;
  };
  static Parameters& ofThread() {
    static thread_local Parameters parameters;
    return parameters;
  }

  const Grid& g_;
  AlignedVector<float>&u_, &v_;
  UvRect laid_{0, 0, 0, 0};  ///< The rectangle that u_ and v_ belong to.
};

Grid emptyGrid(const Object& o, int object, std::span<const PatchPiece> pieces, int nu, int nv, int keyCount,
               Pool* pool) {
  const Prim& prim = o.shape();
  Grid g;
  g.object = object;
  g.pieces.clear();
  g.pieces.reserve(pieces.size());
  for (const PatchPiece& p : pieces)
    g.pieces.push_back({p, openEdgesOf(prim.info(p.patch), p.rect), sampleKeyOf(o.sampleKey, p.patch, p.rect, nu, nv)});
  g.allocate(nu, nv, keyCount, floatsOfPoint(prim.primvars()) + displacementFloats(*o.attributes), pool);
  g.kept = keptOfCells(prim, g);
  return g;
}

/// Sets P and N at all keys, and their turns. Returns the transformation of normals at the first key.
mat3 placeVertices(const Object& o, const DiceKeys& keys, PieceLattices& lattices, Grid& g) {
  const int n = g.vertexCount();
  const auto vertices = [&](const Prim& shape, Evaluated& out) {
    lattices.forEach([&](const Grid::Piece& p, int first, const float* u, const float* v) {
      if (isWhole(p.rect))
        shape.evaluateLattice(p.patch, g.nu, g.nv, u, v, out.view(first));
      else
        shape.evaluate(p.patch, g.verticesOfPiece(), u, v, out.view(first));
    });
  };
  const mat4 first = keys.targetFromObject.at(keys.times.front());
  const mat3 normals = normalMatrix(o, first);
  Evaluated e(n);
  for (int key = 0; key < g.keyCount; ++key) {
    const float time = keys.times[static_cast<size_t>(key)];
    const mat4 m = key == 0 ? first : keys.targetFromObject.at(time);
    if (g.keyCount > 1) g.turns.push_back(mat3(m) * glm::inverse(mat3(first)));
    if (key == 0 || o.shapes.size() > 1) evaluateAt(o, time, n, e, vertices);
    transformPoints(m, n, e.triple(Evaluated::kP), {g.P(key, 0), g.P(key, 1), g.P(key, 2)});
    if (key == 0) transformDirections(normals, n, e.triple(Evaluated::kN), {g.N(0), g.N(1), g.N(2)});
  }
  return normals;
}

/// Sets the primitive variables at the first key, whose transformations are m and `normals`. Returns their number of
/// floats.
int interpolatePrimvars(const Prim& prim, const mat4& m, const mat3& normals, PieceLattices& lattices, Grid& g) {
  const int n = g.vertexCount();
  int offset = 0;
  for (size_t k = 0; k < prim.primvars().size(); ++k) {
    const Primvar& p = prim.primvars()[k];
    lattices.forEach([&](const Grid::Piece& piece, int first, const float* u, const float* v) {
      if (first == 0 || p.storage != Storage::Constant)
        prim.interpolate(piece.patch, static_cast<int>(k), g.verticesOfPiece(), u, v, g.primvar(offset) + first,
                         g.stride());
    });
    for (int c = 0; p.storage == Storage::Constant && c < p.width; ++c)
      std::fill_n(g.primvar(offset + c), n, g.primvar(offset + c)[0]);
    transformPrimvar(p, m, normals, n, g.primvar(offset), g.stride());
    offset += p.width;
  }
  return offset;
}

}  // namespace

Grid diceAtOpen(const Scene& scene, int object, uint32_t patch, const UvRect& rect, int nu, int nv) {
  const Object& o = scene.objects[static_cast<size_t>(object)];
  const std::vector<float> open{o.keyTimes.front()};
  return dice(scene, object, patch, rect, nu, nv, {open, o.cameraFromObject});
}

Grid dice(const Scene& scene, int object, uint32_t patch, const UvRect& rect, int nu, int nv, const DiceKeys& keys) {
  const PatchPiece piece{patch, rect};
  return dice(scene, object, {&piece, 1}, nu, nv, keys);
}

Grid dice(const Scene& scene, int object, std::span<const PatchPiece> pieces, int nu, int nv, const DiceKeys& keys,
          Pool* pool) {
  const Object& o = scene.objects[static_cast<size_t>(object)];
  const Prim& prim = o.shape();
  prefetch(prim, pieces, [](const PatchPiece& p) { return p.patch; });
  Grid g = emptyGrid(o, object, pieces, nu, nv, static_cast<int>(keys.times.size()), pool);
  PieceLattices lattices(g);
  const mat3 normals = placeVertices(o, keys, lattices, g);
  int filled = interpolatePrimvars(prim, keys.targetFromObject.at(keys.times.front()), normals, lattices, g);
  for (int left = displacementFloats(*o.attributes); left > 0; --left)  // the shader may fail, or assign none
    std::fill_n(g.primvar(filled++), g.vertexCount(), 0.0f);
  lattices.forEach([&](const Grid::Piece& p, int first, const float* u, const float* v) {
    prim.surfaceParameters(p.patch, g.verticesOfPiece(), u, v, g.u() + first, g.v() + first);
  });

  // A normal that the user gives is the shading normal (RISpec 5.2); the geometric one is still measured from P.
  if (const int offset = offsetOf(prim.primvars(), "N"); offset >= 0)
    for (int axis = 0; axis < 3; ++axis) std::copy_n(g.primvar(offset + axis), g.vertexCount(), g.N(axis));
  return g;
}

}  // namespace tomales

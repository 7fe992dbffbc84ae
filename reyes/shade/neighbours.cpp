#include "reyes/shade/neighbours.h"

#include "reyes/grid.h"

namespace tomales {
namespace {

int32_t* indices(Arena& arena, int n) {
  static_assert(sizeof(int32_t) == sizeof(float));
  return reinterpret_cast<int32_t*>(arena.floats(n));
}

/// Moves element `to` from element `from` by `half` of a micropolygon along u or v.
void move(const ShadePoints& from, int i, bool alongV, float half, bool parallel, ShadePoints& out, int to) {
  const vec3 edge = from.get3(alongV ? kDpdvX : kDpduX, i) * from.channel(alongV ? kDv : kDu)[i];
  out.set3(kPx, to, from.position(i) + half * edge);
  if (!parallel) out.set3(kIx, to, from.get3(kIx, i) + half * edge);
  const auto step = [&](int value) { return half * from.step(value, alongV)[i]; };
  out.channel(kU)[to] += step(kStepU);
  out.channel(kV)[to] += step(kStepV);
  out.channel(kS)[to] += step(kStepS);
  out.channel(kT)[to] += step(kStepT);
  const vec3 N = from.get3(kNx, i);
  out.set3(kNx, to, normalizeOr(N + vec3(step(kStepN), step(kStepN + 1), step(kStepN + 2)), N));
  for (int k = 0; k < from.primvarFloats(); ++k) out.primvar(k)[to] += step(kStepPrimvars + k);
}

}  // namespace

Stencil stencilOf(const Grid& g, Arena& arena) {
  const int n = g.vertexCount(), row = g.nu + 1;
  int32_t* index[4];
  for (auto& list : index) list = indices(arena, n);
  for (int j = 0, k = 0; j <= g.nv; ++j) {
    const int before = std::max(j - 1, 0) * row, here = j * row, behind = std::min(j + 1, g.nv) * row;
    for (int i = 0; i <= g.nu; ++i, ++k) {
      index[0][k] = here + std::max(i - 1, 0);
      index[1][k] = here + std::min(i + 1, g.nu);
      index[2][k] = before + i;
      index[3][k] = behind + i;
    }
  }
  return {{index[0], index[2]}, {index[1], index[3]}, {1, row}};
}

Widened widened(const ShadePoints& points, bool parallel, Arena& arena) {
  const int n = points.count();
  Widened out{ShadePoints(points.group(), points.primvarFloats(), true), {}};
  out.points.reserve(Widened::kWide * n);
  for (int side = 0; side < Widened::kWide; ++side)
    for (int i = 0; i < n; ++i) out.points.add(points.name(i));
  for (int c = 0; c < points.channelCount(); ++c)
    for (int side = 0; side < Widened::kWide; ++side)
      std::copy_n(points.channel(c), n, out.points.channel(c) + side * n);
  for (int side = 0; side < Widened::kSides; ++side)
    for (int i = 0; i < n; ++i)
      move(points, i, side >= 2, side % 2 ? 0.5f : -0.5f, parallel, out.points, (side + 1) * n + i);
  int32_t* index[Widened::kSides];
  for (int side = 0; side < Widened::kSides; ++side) {
    index[side] = indices(arena, Widened::kWide * n);
    for (int i = 0; i < Widened::kWide * n; ++i) index[side][i] = (side + 1) * n + i % n;
  }
  out.stencil = {{index[0], index[2]}, {index[1], index[3]}};
  return out;
}

}  // namespace tomales

// The surface: derivatives, normals, spaces, random numbers.
#include <cmath>

#include "reyes/rsl/machine/call.h"
#include "reyes/shader.h"

namespace tomales::compiler {
namespace {

/// Gives the change of a value over one micropolygon. It is pure, so it works on all points, active or not.
template <int direction>
void step(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const int32_t from = s.of->in[0], to = s.of->out[0], width = floatsOf(run.reg(to));
  const Lanes &in = run.lane(from), &out = run.lane(to);
  if (out.block == 0 || in.block == 0) {
    for (ptrdiff_t c = 0; c < width; ++c)
      std::fill_n(out.data + c * out.component, out.block == 0 ? kBlock : run.padded, 0.0f);
    return;
  }
  run.grid.active = run.given.active;
  const float* const size = direction == 0 ? run.grid.du : run.grid.dv;
  for (ptrdiff_t c = 0; c < width; ++c) {
    float* const change = out.data + c * out.component;
    call.services.derivative(call.host, &run.grid, direction, in.data + c * in.component, change);
    for (int32_t i = 0; i < run.padded; ++i) change[i] *= size[i];
  }
}

void calculateNormal(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  call.services.calculateNormal(call.host, call.g, call.triple(0), call.giveTriple());
}

void transformSpace(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  call.services.transform(call.host, call.g, s.of->extra, call.text(0), call.text(1), call.triple(2),
                          call.giveTriple());
}

/// Finds the matrix between two spaces from the origin and the ends of the axes; a fifth point shows whether the map is
/// affine.
void spaceMatrix(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const auto n = static_cast<size_t>(run.padded);
  float* const place = run.memory.floats(3 * n);
  const int32_t first = run.firstActive();
  rsl::Vec3 at[5];
  for (int k = 0; k < 5; ++k) {
    for (size_t c = 0; c < 3; ++c) std::fill_n(place + c * n, n, k == 4 || k == static_cast<int>(c) + 1 ? 1.0f : 0.0f);
    const TmVec3 p{place, place + n, place + 2 * n};
    call.services.transform(call.host, call.g, TM_AS_POINT, call.text(0), call.text(1), rsl::view(p), p);
    at[k] = rsl::get(p, first);
  }
  const rsl::Vec3 x = at[1] - at[0], y = at[2] - at[0], z = at[3] - at[0], end = at[0] + x + y + z;
  const float error = rsl::length(end - at[4]),
              size = rsl::length(x) + rsl::length(y) + rsl::length(z) + rsl::length(at[0]);
  if (!(error <= 1e-4f * size))
    run.missing(std::string("asks for the matrix from \"") + call.text(0) + "\" to \"" + call.text(1) +
                "\", which is a projection; transform() knows such spaces, matrices do not");
  const float rows[16] = {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, at[0].x, at[0].y, at[0].z, 1};
  const int32_t to = s.of->out[0];
  for (ptrdiff_t k = 0; k < 16; ++k)
    std::fill_n(run.lane(to).data + k * run.stride(to), run.varies(to) ? run.padded : kBlock, rows[k]);
}

/// Gives another number in [0, 1) at every call, as sl::randomNumber(): a hash whose key is the point's first
/// stratified sample.
void randomInto(Call& call, const float* x, const float* y, float* out) {
  Run& run = call.run;
  const int32_t which = run.randoms++;
  for (int32_t i = 0; i < run.count; ++i)
    if (run.mask->on[i])
      out[i] = static_cast<float>(rsl::latticeHash(static_cast<int32_t>(x[i] * 0x1p24f),
                                                   static_cast<int32_t>(y[i] * 0x1p24f), which) >>
                                  8) *
               0x1p-24f;
}

template <int numbers>
void random(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const auto n = static_cast<size_t>(run.padded);
  float *const x = run.memory.floats(n), *const y = run.memory.floats(n);
  call.services.stratified(call.host, call.g, 0, 1, x, y);
  if constexpr (numbers == 1) {
    randomInto(call, x, y, call.giveNumber());
  } else {
    const TmVec3 out = call.giveTriple();
    for (float* const c : {out.x, out.y, out.z}) randomInto(call, x, y, c);
  }
}

/// Gives one number to all points on surfaces of one name, as sl::randomGrid().
void randomGrid(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  uint32_t hash = 0;
  int32_t type = 0;
  TmValue name{};
  if (call.services.ask(call.host, call.g, TM_OF_ATTRIBUTES, -1, "identifier:name", &type, &name) && type == TM_STRING)
    for (const char* c = name.string; *c; ++c) hash = rsl::latticeHash(static_cast<int32_t>(hash), *c, 0);
  call.set(static_cast<float>(rsl::latticeHash(static_cast<int32_t>(hash), run.randoms++, 1) >> 8) * 0x1p-24f);
}

constexpr Row kSurfaceRows[] = {{Op::StepU, step<0>},
                                {Op::StepV, step<1>},
                                {Op::CalculateNormal, calculateNormal},
                                {Op::TransformSpace, transformSpace},
                                {Op::SpaceMatrix, spaceMatrix},
                                {Op::RandomF, random<1>},
                                {Op::RandomT, random<3>},
                                {Op::RandomGrid, randomGrid}};

}  // namespace

std::span<const Row> surfaceRows() { return kSurfaceRows; }

}  // namespace tomales::compiler

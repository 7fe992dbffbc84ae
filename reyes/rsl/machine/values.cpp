// Pure instructions that need texts or many knots: color spaces and splines. Like kernels they work on all points.
#include "reyes/rsl/machine/table.h"
#include "reyes/shader/noise.h"
#include "reyes/shader/shadeops.h"

namespace tomales::compiler {
namespace {

/// Returns the number of points to work on: one if the result is uniform.
int32_t pointsOf(const Run& run, int32_t to) { return run.varies(to) ? run.padded : 1; }

/// Reads component c of a register at a point. Registers of one value have room for kBlock points. A number counts for
/// all components of the triple that is wanted.
class Reader {
 public:
  Reader(const Run& run, int32_t r)
      : data_(run.lane(r).data),
        stride_(run.reg(r).shape == Shape::Number && run.reg(r).length == 0 ? 0 : run.stride(r)),
        step_(run.varies(r) ? 1 : 0) {}
  float operator()(int32_t i, ptrdiff_t c = 0) const { return data_[c * stride_ + i * step_]; }

 private:
  const float* data_;
  ptrdiff_t stride_;
  int32_t step_;
};

void write(const Run& run, int32_t to, int32_t i, ptrdiff_t c, float x) {
  float* const out = run.lane(to).data + c * run.stride(to);
  if (run.varies(to))
    out[i] = x;
  else
    std::fill_n(out, kBlock, x);
}

rsl::ColorSpace colorSpace(Run& run, int32_t name) {
  const std::string& space = run.text(name);
  if (!rsl::isColorSpace(space))
    run.warn("names the color space \"" + space + "\", which is unknown; it counts as rgb");
  return rsl::colorSpaceOf(space);
}

void colorTransform(Run& run, const PreparedInstruction& s) {
  const rsl::ColorSpace from = colorSpace(run, s.of->in[0]), into = colorSpace(run, s.of->in[1]);
  const int32_t to = s.of->out[0];
  const Reader color(run, s.of->in[2]);
  for (int32_t i = 0; i < pointsOf(run, to); ++i) {
    const rsl::Color c = rsl::ctransform(from, into, {color(i, 0), color(i, 1), color(i, 2)});
    write(run, to, i, 0, c.x);
    write(run, to, i, 1, c.y);
    write(run, to, i, 2, c.z);
  }
}

/// The knots of a spline, from one register each or from an array.
struct Knots {
  std::vector<Reader> readers;
  int32_t count = 0, width = 1;
  bool array = false, vary = false;
  Knots(const Run& run, const Instruction& of, int32_t components) : width(components) {
    for (size_t k = 2; k < of.in.size(); ++k) readers.emplace_back(run, of.in[k]);
    for (size_t k = 2; k < of.in.size(); ++k) vary |= run.varies(of.in[k]);
    array = readers.size() == 1 && run.reg(of.in[2]).length > 0;
    count = array ? run.reg(of.in[2]).length : static_cast<int32_t>(readers.size());
  }
  float at(int32_t knot, int32_t component, int32_t i) const {
    return array ? readers[0](i, knot * width + component) : readers[static_cast<size_t>(knot)](i, component);
  }
  /// Repeats the last knot if there are fewer than four.
  void fill(std::vector<float>& own, int32_t component, int32_t i) const {
    for (size_t k = 0; k < own.size(); ++k) own[k] = at(std::min(static_cast<int32_t>(k), count - 1), component, i);
  }
};

float curve(rsl::Basis basis, bool solved, float x, const std::vector<float>& knots) {
  const auto n = static_cast<int>(knots.size());
  return solved ? rsl::solveSpline(basis, x, knots.data(), n) : rsl::spline(basis, x, knots.data(), n);
}

/// Bases are those of reyes/shader/noise.h, "solve..." their inverses.
void spline(Run& run, const PreparedInstruction& s) {
  constexpr std::string_view kSolve = "solve";
  std::string name = run.text(s.of->in[0]);
  const bool solved = name.starts_with(kSolve);
  if (solved) name.erase(0, kSolve.size());
  const std::optional<rsl::Basis> known = rsl::basisNamed(name);
  if (!known) run.warn("asks for a spline of basis \"" + name + "\", which is unknown; it is a Catmull-Rom spline");
  const rsl::Basis basis = known.value_or(rsl::Basis::CatmullRom);
  const int32_t to = s.of->out[0], width = floatsOf(run.reg(to));
  const Reader x(run, s.of->in[1]);
  const Knots knots(run, *s.of, width);
  if (knots.count == 0) return;
  std::vector<float> own(static_cast<size_t>(std::max(4, knots.count)));
  for (int32_t c = 0; c < width; ++c)
    for (int32_t i = 0; i < pointsOf(run, to); ++i) {
      if (i == 0 || knots.vary) knots.fill(own, c, i);
      write(run, to, i, c, curve(basis, solved, x(i), own));
    }
}

constexpr Row kValueRows[] = {{Op::ColorTransform, colorTransform}, {Op::SplineF, spline}, {Op::SplineT, spline}};

}  // namespace

std::span<const Row> valueRows() { return kValueRows; }

}  // namespace tomales::compiler

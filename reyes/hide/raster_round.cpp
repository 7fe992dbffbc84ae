// Rasterises small disks that stand still and are in focus. Each is the ellipse that touches the four edges of its cell
// (Grid::round): exact, without corners, and tested by two lines instead of five (docs/decisions/0051).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reyes/hide/raster_round.cpp"
#include "reyes/base/vector.h"  // Includes this file again for each target.

#include "reyes/hide/sample_cell.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

/// A cell abcd, taken as a parallelogram around the middle of bc with half edges e (along u) and f.
struct Oval {
  vec2 center, e, f, slope;  ///< slope: gradient of the depth key.
  float d, dMin, dMax, area;

  Oval(const RasterGrid& r, size_t a) {
    const float *x = r.x.data() + a, *y = r.y.data() + a, *depth = r.d.data() + a;
    const vec2 pa(x[0], y[0]), pb(x[1], y[1]), pc(x[2], y[2]);
    center = 0.5f * (pb + pc);
    e = 0.5f * (pb - pa);
    f = 0.5f * (pc - pa);
    area = e.x * f.y - e.y * f.x;
    d = 0.5f * (depth[1] + depth[2]);
    dMin = std::min({depth[0], depth[1], depth[2], depth[3]});
    dMax = std::max({depth[0], depth[1], depth[2], depth[3]});
    const float alongE = 0.5f * (depth[1] - depth[0]), alongF = 0.5f * (depth[2] - depth[0]);
    slope = vec2(alongE * f.y - alongF * e.y, alongF * e.x - alongE * f.x) / area;
  }
  vec2 reach() const { return {std::sqrt(e.x * e.x + f.x * f.x), std::sqrt(e.y * e.y + f.y * f.y)}; }
};

class Round {
 public:
  explicit Round(const Oval& o)
      : x_(all(o.center.x)),
        y_(all(o.center.y)),
        ux_(all(o.f.y / o.area)),
        uy_(all(-o.f.x / o.area)),
        vx_(all(-o.e.y / o.area)),
        vy_(all(o.e.x / o.area)),
        d_(all(o.d)),
        gx_(all(o.slope.x)),
        gy_(all(o.slope.y)),
        dMin_(all(o.dMin)),
        dMax_(all(o.dMax)),
        depthError_(depthErrorBound(std::abs(o.slope.x) + std::abs(o.slope.y), o.d)) {}

  struct Covered {
    Mask mask;
  };
  HWY_INLINE Covered covers(const SampleBuffer& samples, size_t lane) const {
    const Floats x = hn::Sub(hn::Load(kF, samples.x.data() + lane), x_),
                 y = hn::Sub(hn::Load(kF, samples.y.data() + lane), y_);
    const Floats u = hn::Add(hn::Mul(x, ux_), hn::Mul(y, uy_)), v = hn::Add(hn::Mul(x, vx_), hn::Mul(y, vy_));
    return {hn::Lt(hn::Add(hn::Mul(u, u), hn::Mul(v, v)), all(1.0f))};
  }
  HWY_INLINE Floats depth(Floats sampleX, Floats sampleY, const Covered&) const {
    const Floats x = hn::Sub(sampleX, x_), y = hn::Sub(sampleY, y_);
    const Floats d = hn::Add(d_, hn::Add(hn::Mul(x, gx_), hn::Mul(y, gy_)));
    // The depth stays within that of the cell, or culling by dMin would depend on rounding.
    return hn::Min(hn::Max(d, dMin_), dMax_);
  }
  float depthError() const { return depthError_; }

 private:
  Floats x_, y_, ux_, uy_, vx_, vy_, d_, gx_, gy_, dMin_, dMax_;
  float depthError_;
};

void rasterizeOvals(const RasterJob& job) {
  const RasterGrid& r = job.raster;
  const Grid& g = *r.grid;
  for (int p = 0, cell = 0; p < g.pieceCount(); ++p, cell += g.nu * (g.nv + 1)) {
    const Kept kept = keptOf(job, cell);
    if (kept == Kept::None) continue;
    const Oval oval(r, static_cast<size_t>(p * g.verticesOfPiece()));
    if (oval.area == 0 || r.facing * oval.area < 0) continue;
    const vec2 reach = oval.reach();
    const PixelRect pixels = job.out.touched(oval.center - reach, oval.center + reach);
    const auto round = [&] { return Round(oval); };
    const uint32_t number = job.firstCell + static_cast<uint32_t>(cell);
    if (r.opaque)
      sampleCell<true>(job, pixels, oval.dMin, number, kept, round);
    else
      sampleCell<false>(job, pixels, oval.dMin, number, kept, round);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tomales {
HWY_EXPORT(rasterizeOvals);
void rasterizeRound(const RasterJob& job) { HWY_DYNAMIC_DISPATCH(rasterizeOvals)(job); }
}  // namespace tomales
#endif

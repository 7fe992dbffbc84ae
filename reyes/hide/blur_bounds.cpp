#include "reyes/hide/blur_bounds.h"

#include "reyes/base/check.h"

namespace tomales {
namespace {

constexpr float kMargin_px = 1.0f / 64;
constexpr float kRounding = 0x1p-20f;  ///< Relative to the largest coordinate: some units in the last place.
/// Relative to the distance from the first vertex: the rounding of a conversion to slanted coordinates and back.
constexpr float kSlanting = 0x1p-15f;

/// Boxes of a level, row by row, each row with one more than it needs. They bound slanted x and y relative to the
/// grid's first vertex and, if the grid is out of focus, the depth key, at the two keys of a segment.
struct Extents {
  int columns, rows, axes;
  std::vector<float> lo[2][3], hi[2][3];

  int pitch() const { return columns + 1; }
  int count() const { return pitch() * rows; }
  void resize(int c, int r, int a) {
    columns = c;
    rows = r;
    axes = a;
    for (int key = 0; key < 2; ++key)
      for (int axis = 0; axis < axes; ++axis)
        for (auto* values : {&lo[key][axis], &hi[key][axis]}) values->resize(static_cast<size_t>(count()) + 1);
  }
};

float least(float a, float b) { return b < a ? b : a; }
float greatest(float a, float b) { return b > a ? b : a; }

/// Bounds the cells of a lattice. The last vertex of a row begins no cell, so its entry is meaningless.
TOMALES_HOT void extendCells(const float* v, int row, int count, float* __restrict lo, float* __restrict hi) {
  const float *b = v + 1, *c = v + row, *d = c + 1;
  for (int i = 0; i < count; ++i) {
    lo[i] = least(least(v[i], b[i]), least(c[i], d[i]));
    hi[i] = greatest(greatest(v[i], b[i]), greatest(c[i], d[i]));
  }
}

/// Returns the minimum. Each lane of a vector keeps its own, so that the loop vectorises. GCC takes a loop over few
/// lanes apart before that, so there are many.
TOMALES_HOT float leastOf(const float* v, int count) {
  constexpr int kMany = 2 * kLanes;
  float lanes[kMany], out = kInfinity;
  std::fill_n(lanes, kMany, kInfinity);
  int i = 0;
  for (; i + kMany <= count; i += kMany)
    for (int k = 0; k < kMany; ++k) lanes[k] = least(lanes[k], v[i + k]);
  for (const float lane : lanes) out = least(out, lane);
  for (; i < count; ++i) out = least(out, v[i]);
  return out;
}

/// Joins two boxes of two rows each; at odd ends a box is used twice.
template <class Extreme>
void halve(const Extents& from, std::vector<float>& values, const Extreme& extreme, float* out) {
  const int columns = from.columns, pitch = from.pitch();
  for (int j = 0; j < from.rows; j += 2, out += (columns + 1) / 2 + 1) {
    float *a = values.data() + j * pitch, *b = values.data() + std::min(j + 1, from.rows - 1) * pitch;
    a[columns] = a[columns - 1];
    b[columns] = b[columns - 1];
    for (int i = 0; i < (columns + 1) / 2; ++i)
      out[i] = extreme(extreme(a[2 * i], a[2 * i + 1]), extreme(b[2 * i], b[2 * i + 1]));
  }
}

void halve(Extents& from, Extents& to) {
  to.resize((from.columns + 1) / 2, (from.rows + 1) / 2, from.axes);
  for (int key = 0; key < 2; ++key)
    for (int axis = 0; axis < from.axes; ++axis) {
      halve(from, from.lo[key][axis], least, to.lo[key][axis].data());
      halve(from, from.hi[key][axis], greatest, to.hi[key][axis].data());
    }
}

/// Linear motion of boxes. Every vertex stays within a box whose sides move linearly; the larger half size is used for
/// all times.
struct Motions {
  std::vector<float> center, step, reach, most;

  void set(const Extents& e, int axis) {
    for (auto* values : {&center, &step, &reach, &most}) values->resize(static_cast<size_t>(e.count()));
    set(e.count(), e.lo[0][axis].data(), e.hi[0][axis].data(), e.lo[1][axis].data(), e.hi[1][axis].data(),
        center.data(), step.data(), reach.data(), most.data());
  }

 private:
  TOMALES_HOT static void set(int count, const float* lo0, const float* hi0, const float* lo1, const float* hi1,
                              float* __restrict center, float* __restrict step, float* __restrict reach,
                              float* __restrict most) {
    for (int i = 0; i < count; ++i) {
      const float c0 = 0.5f * (lo0[i] + hi0[i]), c1 = 0.5f * (lo1[i] + hi1[i]);
      center[i] = c0;
      step[i] = c1 - c0;
      reach[i] = greatest(hi0[i] - c0, hi1[i] - c1);
      most[i] = greatest(greatest(std::abs(lo0[i]), std::abs(hi0[i])), greatest(std::abs(lo1[i]), std::abs(hi1[i])));
    }
  }
};

/// Positions of a grid's first vertex at the keys of a segment, and the slant of its boxes.
struct Frame {
  vec2 origin[2], slant;

  vec2 rounding_px() const {
    const vec2 far = glm::max(glm::abs(origin[0]), glm::abs(origin[1]));
    return (1.0f + glm::abs(slant)) * (kMargin_px + kRounding * std::max(far.x, far.y));
  }
};

/// The slant follows the lines of the grid if they lie crosswise: an upright box around a slanted square is twice as
/// large.
vec2 slantOf(const RasterGrid& r, int firstKey, int lastKey) {
  const Grid& g = *r.grid;
  vec2 along(0), across(0);
  for (const int key : {firstKey, lastKey}) {
    const auto at = [&](int vertex) {
      const auto v = static_cast<size_t>(key * g.stride() + vertex);
      return vec2(r.x[v], r.y[v]);
    };
    const vec2 a = at(0), b = at(g.nu), c = at(g.nv * (g.nu + 1)), d = at(g.vertexCount() - 1);
    along += b - a + d - c;
    across += c - a + d - b;
  }
  if (std::abs(along.y * across.x) > std::abs(along.x * across.y)) std::swap(along, across);
  const auto ratio = [](float a, float b) { return std::abs(a) <= std::abs(b) && b != 0 ? -a / b : 0.0f; };
  const vec2 slant(ratio(across.x, across.y), ratio(along.y, along.x));
  return 1 - slant.x * slant.y > 0.5f ? slant : vec2(0);
}

/// Computes slanted coordinates of vertices.
TOMALES_HOT void slantAll(const float* x, const float* y, const vec2& from, const vec2& slant, int count,
                          float* __restrict slantX, float* __restrict slantY) {
  const vec2 o = from, s = slant;
  for (int v = 0; v < count; ++v) {
    const float dx = x[v] - o.x, dy = y[v] - o.y;
    slantX[v] = dx + s.x * dy;
    slantY[v] = dy + s.y * dx;
  }
}

/// Makes the boxes of a row, from number `first` on, from slanted coordinates; without a lens.
TOMALES_HOT void makeBoxes(const Motions& x, const Motions& y, const Frame& frame, size_t first, int count,
                           BlurBox* __restrict out) {
  const vec2 o = frame.origin[0], oStep = frame.origin[1] - o, slant = frame.slant, margin = frame.rounding_px();
  const float upright = 1 / (1 - slant.x * slant.y);
  const float *xs = x.center.data() + first, *ys = y.center.data() + first, *xSteps = x.step.data() + first,
              *ySteps = y.step.data() + first;
  const float *xReach = x.reach.data() + first, *yReach = y.reach.data() + first, *xMost = x.most.data() + first,
              *yMost = y.most.data() + first;
  for (int i = 0; i < count; ++i) {
    const float rounding = kSlanting * (xMost[i] + yMost[i]);
    out[i] = {o.x + upright * (xs[i] - slant.x * ys[i]),
              o.y + upright * (ys[i] - slant.y * xs[i]),
              0,
              oStep.x + upright * (xSteps[i] - slant.x * ySteps[i]),
              oStep.y + upright * (ySteps[i] - slant.y * xSteps[i]),
              0,
              xReach[i] + margin.x + rounding,
              yReach[i] + margin.y + rounding};
  }
}

void makeBoxes(const Extents& e, const Frame& frame, const vec2& lens, BlurBox* out) {
  static thread_local Motions x, y, d;
  x.set(e, 0);
  y.set(e, 1);
  for (int j = 0; j < e.rows; ++j)
    makeBoxes(x, y, frame, static_cast<size_t>(j * e.pitch()), e.columns, out + j * e.columns);
  if (e.axes < 3) return;
  d.set(e, 2);
  const vec2 blur = glm::abs(lens) + glm::abs(frame.slant) * glm::abs(vec2(lens.y, lens.x));
  for (int j = 0; j < e.rows; ++j)
    for (size_t i = static_cast<size_t>(j * e.pitch()), end = i + static_cast<size_t>(e.columns); i < end; ++i, ++out) {
      const float reach = d.reach[i] + kRounding * d.most[i];
      out->d = d.center[i];
      out->dStep = d.step[i];
      out->xReach += blur.x * reach;
      out->yReach += blur.y * reach;
    }
}

std::vector<BlurBounds::Level> levelsOf(const Grid& g) {
  std::vector<BlurBounds::Level> levels{{g.nu, g.nv, 0}};
  while (levels.back().columns > 1 || levels.back().rows > 1) {
    const BlurBounds::Level& l = levels.back();
    levels.push_back({(l.columns + 1) / 2, (l.rows + 1) / 2, l.first + static_cast<size_t>(l.columns * l.rows)});
  }
  return levels;
}

}  // namespace

std::shared_ptr<const BlurBounds> boundBlur(const RasterGrid& r, const Camera& camera, Pool* pool) {
  const Grid& g = *r.grid;
  CHECK_EQ(g.pieceCount(), 1);
  const int segments = std::max(1, g.keyCount - 1), row = g.nu + 1, axes = r.defocused ? 3 : 2;
  auto bounds = std::make_shared<BlurBounds>();
  bounds->levels = levelsOf(g);
  bounds->boxesPerSegment = bounds->levels.back().first + 1;
  bounds->boxes = PooledVector<BlurBox>(bounds->boxesPerSegment * static_cast<size_t>(segments), pool);
  static thread_local Extents fine, coarse;
  static thread_local std::vector<float> slantX, slantY;
  slantX.resize(static_cast<size_t>(g.vertexCount()));
  slantY.resize(slantX.size());
  for (int segment = 0; segment < segments; ++segment) {
    const int keys[2] = {std::min(segment, g.keyCount - 1), std::min(segment + 1, g.keyCount - 1)};
    Frame frame{{}, slantOf(r, keys[0], keys[1])};
    float dMin = kInfinity;
    fine.resize(g.nu, g.nv, axes);
    for (int k = 0; k < 2; ++k) {
      const ptrdiff_t first = ptrdiff_t{keys[k]} * g.stride();
      const float *x = r.x.data() + first, *y = r.y.data() + first, *d = r.d.data() + first;
      frame.origin[k] = {x[0], y[0]};
      slantAll(x, y, frame.origin[k], frame.slant, g.vertexCount(), slantX.data(), slantY.data());
      const float* of[3] = {slantX.data(), slantY.data(), d};
      for (int axis = 0; axis < axes; ++axis)
        extendCells(of[axis], row, fine.count() - 1, fine.lo[k][axis].data(), fine.hi[k][axis].data());
      dMin = std::min(dMin, leastOf(d, g.vertexCount()));
    }
    bounds->segments.push_back({dMin, frame.slant});
    BlurBox* boxes = bounds->boxes.data() + static_cast<size_t>(segment) * bounds->boxesPerSegment;
    for (const BlurBounds::Level& level : bounds->levels) {
      if (level.first > 0) {
        halve(fine, coarse);
        std::swap(fine, coarse);
      }
      makeBoxes(fine, frame, camera.lens(), boxes + level.first);
    }
  }
  return bounds;
}

}  // namespace tomales

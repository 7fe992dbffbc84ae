#include "reyes/hide/blur_bounds.h"

#include "reyes/base/check.h"

namespace tomales {
namespace {

constexpr float kMargin_px = 1.0f / 64;
constexpr float kRounding = 0x1p-20f;  ///< Of the largest coordinate: some units in the last place.

/// For a level, a row after the other, each with one box more than there are: of raster x, y and, if the lens
/// counts, depth key the least and the greatest at the two keys of a segment.
struct Extents {
  int columns, rows, axes;
  std::vector<float> lo[2][3], hi[2][3];

  int pitch() const { return columns + 1; }
  int count() const { return pitch() * rows; }
  void resize(int c, int r, int a) {
    columns = c, rows = r, axes = a;
    for (int key = 0; key < 2; ++key)
      for (int axis = 0; axis < axes; ++axis)
        for (auto* values : {&lo[key][axis], &hi[key][axis]}) values->resize(static_cast<size_t>(count()) + 1);
  }
};

float least(float a, float b) { return b < a ? b : a; }
float greatest(float a, float b) { return b > a ? b : a; }

/// Of the cells of a lattice; the last of a row, which begins no cell, has any.
TOMALES_HOT void extendCells(const float* v, int row, int count, float* __restrict lo, float* __restrict hi) {
  const float *b = v + 1, *c = v + row, *d = c + 1;
  for (int i = 0; i < count; ++i) {
    lo[i] = least(least(v[i], b[i]), least(c[i], d[i]));
    hi[i] = greatest(greatest(v[i], b[i]), greatest(c[i], d[i]));
  }
}

/// Lanes of a vector keep their own.
TOMALES_HOT float leastOf(const float* v, int count) {
  float lanes[kLanes];
  for (float& l : lanes) l = kInfinity;
  int i = 0;
  for (; i + kLanes <= count; i += kLanes)
    for (int k = 0; k < kLanes; ++k) lanes[k] = least(lanes[k], v[i + k]);
  for (; i < count; ++i) lanes[0] = least(lanes[0], v[i]);
  return *std::min_element(lanes, lanes + kLanes);
}

/// Two boxes of two rows each; odd ends are looked at twice.
template <class Extreme>
void halve(const Extents& from, std::vector<float>& values, const Extreme& extreme, float* out) {
  const int columns = from.columns, pitch = from.pitch();
  for (int j = 0; j < from.rows; j += 2, out += (columns + 1) / 2 + 1) {
    float *a = values.data() + j * pitch, *b = values.data() + std::min(j + 1, from.rows - 1) * pitch;
    a[columns] = a[columns - 1], b[columns] = b[columns - 1];
    for (int i = 0; i < (columns + 1) / 2; ++i) out[i] = extreme(extreme(a[2 * i], a[2 * i + 1]), extreme(b[2 * i], b[2 * i + 1]));
  }
}

void halve(Extents& from, Extents& to) {
  to.resize((from.columns + 1) / 2, (from.rows + 1) / 2, from.axes);
  for (int key = 0; key < 2; ++key)
    for (int axis = 0; axis < from.axes; ++axis)
      halve(from, from.lo[key][axis], least, to.lo[key][axis].data()), halve(from, from.hi[key][axis], greatest, to.hi[key][axis].data());
}

/// Linear motion keeps every vertex within the box whose sides move linearly; the larger half size serves all times.
struct Motions {
  std::vector<float> center, step, reach, most;

  void set(const Extents& e, int axis) {
    for (auto* values : {&center, &step, &reach, &most}) values->resize(static_cast<size_t>(e.count()));
    set(e.count(), e.lo[0][axis].data(), e.hi[0][axis].data(), e.lo[1][axis].data(), e.hi[1][axis].data(), center.data(), step.data(), reach.data(),
        most.data());
  }

 private:
  TOMALES_HOT static void set(int count, const float* lo0, const float* hi0, const float* lo1, const float* hi1, float* __restrict center,
                              float* __restrict step, float* __restrict reach, float* __restrict most) {
    for (int i = 0; i < count; ++i) {
      const float c0 = 0.5f * (lo0[i] + hi0[i]), c1 = 0.5f * (lo1[i] + hi1[i]);
      center[i] = c0, step[i] = c1 - c0, reach[i] = greatest(hi0[i] - c0, hi1[i] - c1);
      most[i] = greatest(greatest(std::abs(lo0[i]), std::abs(hi0[i])), greatest(std::abs(lo1[i]), std::abs(hi1[i])));
    }
  }
};

void appendBoxes(const Extents& e, const vec2& lens, PooledVector<BlurBox>& out) {
  static thread_local Motions x, y, d;
  x.set(e, 0), y.set(e, 1);
  const bool defocused = e.axes == 3;
  if (defocused) d.set(e, 2);
  const vec2 blur = glm::abs(lens);
  for (int j = 0; j < e.rows; ++j)
    for (size_t i = static_cast<size_t>(j * e.pitch()), end = i + static_cast<size_t>(e.columns); i < end; ++i) {
      BlurBox& box = out.emplace_back();
      box = {x.center[i],
             y.center[i],
             0,
             x.step[i],
             y.step[i],
             0,
             x.reach[i] + kMargin_px + kRounding * x.most[i],
             y.reach[i] + kMargin_px + kRounding * y.most[i]};
      if (!defocused) continue;
      box.d = d.center[i], box.dStep = d.step[i];
      box.xReach += blur.x * (d.reach[i] + kRounding * d.most[i]),
          box.yReach += blur.y * (d.reach[i] + kRounding * d.most[i]);
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
  bounds->boxes = PooledVector<BlurBox>(pool);
  bounds->boxes.reserve(bounds->boxesPerSegment * static_cast<size_t>(segments));
  static thread_local Extents fine, coarse;
  for (int segment = 0; segment < segments; ++segment) {
    float& dMin = bounds->dMin.emplace_back(kInfinity);
    fine.resize(g.nu, g.nv, axes);
    for (int k = 0; k < 2; ++k) {
      const ptrdiff_t first = ptrdiff_t{std::min(segment + k, g.keyCount - 1)} * g.stride();
      const float* of[3] = {r.x.data() + first, r.y.data() + first, r.d.data() + first};
      for (int axis = 0; axis < axes; ++axis)
        extendCells(of[axis], row, fine.count() - 1, fine.lo[k][axis].data(), fine.hi[k][axis].data());
      dMin = std::min(dMin, leastOf(of[2], g.vertexCount()));
    }
    appendBoxes(fine, camera.lens(), bounds->boxes);
    for (size_t l = 1; l < bounds->levels.size(); ++l) {
      halve(fine, coarse);
      std::swap(fine, coarse);
      appendBoxes(fine, camera.lens(), bounds->boxes);
    }
  }
  return bounds;
}

}  // namespace tomales

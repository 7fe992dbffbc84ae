// The light that a glossy surface mirrors. It is cheap to follow a direction of its lobes, and expensive to shade what
// is met there. So a point that reflects half of the light shades all that its directions meet, and one that reflects a
// twentieth (dielectrics) shades a hundredth. The others are left out by chance, and those that are shaded weigh more
// for it, so that the sum stays unbiased: systematic sampling with probabilities by weight (Madow 1949, "On the Theory
// of Systematic Sampling, II").
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "reyes/shader.h"
#include "reyes/shader/noise.h"

/// Reflections of the points of one batch. Only the points' own numbers decide what is shaded, so a point's light does
/// not depend on the batch.
class Reflections {
 public:
  /// Directions are followed in sets of this many, which bounds the memory. It is a power of two, so that each set of
  /// Sobol points is as even as the whole.
  static constexpr int kTogether = 64;

  /// `number`: how many directions each point draws, at most `directions`; `least` of them are shaded even where little
  /// is reflected. `number` must outlive this.
  Reflections(const rsl::Batch& b, const std::vector<int>& number, int directions, int least)
      : b_(b),
        number_(number),
        least_(least),
        points_(static_cast<size_t>(b.g->count)),
        L_(b.g),
        options_(tmRayDefaults()) {
    options_.drawn = directions;
    options_.passLamps = 1;  // samples of the lights bring lamps and sky
  }

  /// Adds a direction of point i, of unit length, drawn by xi0 and xi1 in [0,1). `weight` multiplies what is seen
  /// there.
  void add(int i, rsl::Vec3 L, rsl::Color weight, float xi0, float xi1) {
    Point& p = points_[static_cast<size_t>(i)];
    const uint32_t place = alongCurve(xi0, xi1);
    if (p.drawn.empty())
      p.start = static_cast<float>(rsl::latticeHash(static_cast<int32_t>(place), 0, 0) >> 8) * 0x1p-24f;
    p.drawn.push_back({L, weight, place});
  }

  /// Adds what is seen along the directions since the last call, at most kTogether of a point.
  void trace(rsl::Vec3Array& sum) {
    const int sent = options_.number;
    int most = 0;
    for (int i : b_) points_[static_cast<size_t>(i)].shaded = shareOf(i);
    forgetMisses();
    for (Point& p : points_) {
      std::stable_sort(p.drawn.begin(), p.drawn.end(), [](const auto& a, const auto& b) { return a.place < b.place; });
      if (p.shaded < p.drawn.size()) thinOut(p);
      most = std::max(most, static_cast<int>(p.drawn.size()));
    }
    for (int k = 0; k < most; ++k) {
      aim(k);
      options_.number = sent + k;
      const rsl::Vec3Array seen = b_.trace(L_, options_);
      for (int i : b_)
        if (const Direction* d = directionOf(i, k)) sum.set(i, sum[i] + d->weight * seen[i]);
    }
    options_.number = sent + kTogether;
    for (Point& p : points_) p.drawn.clear();
  }

 private:
  struct Direction {
    rsl::Vec3 L;
    rsl::Color weight;
    uint32_t place;
    float brightness() const { return (weight.x + weight.y + weight.z) / 3; }
  };
  struct Point {
    std::vector<Direction> drawn;
    size_t shaded = 0;  ///< Greatest number of directions that are shaded.
    float start = 0;    ///< Random number in [0,1).
  };

  /// Morton's curve through the unit square: what is near on it is near in the lobe.
  static uint32_t alongCurve(float x, float y) {
    uint32_t place = 0;
    const auto column = static_cast<uint32_t>(x * 65536), row = static_cast<uint32_t>(y * 65536);
    for (uint32_t bit = 0; bit < 16; ++bit)
      place |= (column >> bit & 1) << (2 * bit + 1) | (row >> bit & 1) << (2 * bit);
    return place;
  }
  /// Returns how many directions are shaded. The variance of what is mirrored grows with the square of its weight, and
  /// so does the number of rays that keeps it below a limit.
  size_t shareOf(int i) const {
    const Point& p = points_[static_cast<size_t>(i)];
    if (p.drawn.empty()) return 0;
    const float number = static_cast<float>(number_[static_cast<size_t>(i)]), size = static_cast<float>(p.drawn.size());
    float reflected = 0;
    for (const Direction& d : p.drawn) reflected += 2 * d.brightness();
    const float share = std::min(1.0f, reflected * number / size);
    return static_cast<size_t>(std::ceil(std::max(static_cast<float>(least_) / number, share * share) * size));
  }
  const Direction* directionOf(int i, int k) const {
    const Point& p = points_[static_cast<size_t>(i)];
    return static_cast<size_t>(k) < p.drawn.size() ? &p.drawn[static_cast<size_t>(k)] : nullptr;
  }
  /// Sets L_ to direction k of each point, and to 0 where there are fewer.
  void aim(int k) {
    for (int i : b_) {
      const Direction* d = directionOf(i, k);
      L_.set(i, d ? d->L : rsl::Vec3{});
    }
  }
  /// Drops the directions that meet nothing. The others are numbered without gaps, so that samples at hits are even
  /// too.
  void forgetMisses() {
    size_t most = 0;
    for (const Point& p : points_) most = std::max(most, p.drawn.size());
    for (int k = 0; k < static_cast<int>(most); ++k) {
      aim(k);
      const rsl::Array distance = b_.traceDistance(L_, options_);
      for (int i : b_)
        if (directionOf(i, k) && !(distance[i] < 1e30f))
          points_[static_cast<size_t>(i)].drawn[static_cast<size_t>(k)].weight = {};
    }
    for (Point& p : points_) std::erase_if(p.drawn, [](const Direction& d) { return !(d.brightness() > 0); });
  }
  /// Keeps as many directions as are shaded, evenly along the curve and by weight.
  static void thinOut(Point& p) {
    float all = 0;
    for (const Direction& d : p.drawn) all += d.brightness();
    const float step = all / static_cast<float>(p.shaded);
    std::vector<Direction> chosen;
    float passed = 0;
    auto d = p.drawn.begin();
    for (size_t k = 0; k < p.shaded; ++k) {
      const float at = step * (static_cast<float>(k) + p.start);
      while (d + 1 != p.drawn.end() && passed + d->brightness() <= at) passed += d++->brightness();
      chosen.push_back({d->L, d->weight * (step / d->brightness()), d->place});
    }
    p.drawn = std::move(chosen);
  }

  const rsl::Batch& b_;
  const std::vector<int>& number_;
  const int least_;
  std::vector<Point> points_;
  rsl::Vec3Array L_;
  TmRayOptions options_;
};

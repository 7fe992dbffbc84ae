#include "reyes/hide/solids.h"

#include <map>
#include <tuple>

#include "reyes/hide/resolve.h"

namespace tomales {
namespace {

/// Surfaces that coincide are found as far apart as vertices are moved to the lattice and depths rounded: by this share of
/// what a micropolygon, which is about a pixel, goes through in depth.
constexpr float kSlackOfCell = 4e-3f;
constexpr float kRounding = 1e-6f;

struct Crossing {
  Layer at;
  int solid;
};

class SolidResolver {
 public:
  SolidResolver(const Scene& scene, const Camera& camera, const GridTable& grids, SampleBuffer& samples)
      : scene_(scene), camera_(camera), grids_(grids), samples_(samples) {}

  void resolve() {
    const std::vector<Crossing> all = sorted();
    for (size_t first = 0, last = 0; first < all.size(); first = last) {
      while (last < all.size() && sameLine(all[first], all[last])) ++last;
      resolveLine({all.data() + first, last - first});
    }
  }

 private:
  const Object& objectOf(uint32_t cell) const {
    return scene_.objects[static_cast<size_t>(grids_.of(cell).grid().object)];
  }

  std::vector<Crossing> sorted() {
    std::vector<Crossing> all;
    all.reserve(samples_.crossings.size());
    for (const Layer& l : samples_.crossings) all.push_back({l, objectOf(l.cell).solid});
    samples_.crossings = {};
    std::sort(all.begin(), all.end(), [this](const Crossing& p, const Crossing& q) {
      const auto key = [](const Crossing& c) { return std::make_tuple(c.at.pixel, c.at.lane, c.solid, c.at.d); };
      return key(p) != key(q) ? key(p) < key(q) : grids_.precedes(p.at.cell, q.at.cell);
    });
    return all;
  }

  static bool sameLine(const Crossing& p, const Crossing& q) {
    return std::tie(p.at.pixel, p.at.lane, p.solid) == std::tie(q.at.pixel, q.at.lane, q.solid);
  }

  SolidCrossing crossing(const Layer& l) const {
    const GridTable::Entry& entry = grids_.of(l.cell);
    const Object& o = objectOf(l.cell);
    const SeenCell s =
        seenCell(entry, camera_, static_cast<int>(l.cell - entry.firstCell), samplePoint(samples_, l.pixel, l.lane));
    const vec2 ad(s.d - s.a), bc(s.c - s.b);
    // Raster y runs down: what turns clockwise from u to v as seen has dPdu x dPdv towards the eye.
    const bool leaving = (ad.x * bc.y - ad.y * bc.x < 0) != o.flipsNormal;
    const float extent = std::max({s.a.z, s.b.z, s.c.z, s.d.z}) - std::min({s.a.z, s.b.z, s.c.z, s.d.z});
    const float rounding = kRounding * std::abs(l.d);
    return {o.solidBlock, leaving, l.d, extent + rounding, kSlackOfCell * extent + rounding};
  }

  void resolveLine(std::span<const Crossing> line) {
    crossings_.clear();
    for (const Crossing& c : line) crossings_.push_back(crossing(c.at));
    const int solid = line.front().solid;
    const auto walk = walks_.try_emplace(solid, scene_.solids[static_cast<size_t>(solid)]).first;
    walk->second.boundaries(crossings_, boundaries_);
    for (const SolidBoundary& b : boundaries_)
      if (visible(line[b.crossing].at, b.entering) && compete(line[b.crossing].at)) return;
  }

  /// The surface of a solid has an outside by itself, whatever way its primitives are turned. It is whole before it is clipped.
  bool visible(const Layer& l, bool entering) const {
    const Attributes& a = *objectOf(l.cell).attributes;
    const SamplePoint sample = samplePoint(samples_, l.pixel, l.lane);
    return a.visibility.camera && (entering || a.sides == 2) && !camera_.clips(sample.at, sample.lens, l.d);
  }

  /// True: it hides all behind it.
  bool compete(const Layer& l) {
    const size_t lane = l.pixel * static_cast<size_t>(samples_.lanes) + l.lane;
    float& depth = samples_.depth[lane];
    if (!grids_.of(l.cell).raster->opaque) {
      samples_.layers.push_back(l);
      return false;
    }
    uint32_t& owner = samples_.cell[lane];
    if (l.d < depth || (l.d == depth && grids_.precedes(l.cell, owner))) depth = l.d, owner = l.cell;
    return true;
  }

  const Scene& scene_;
  const Camera& camera_;
  const GridTable& grids_;
  SampleBuffer& samples_;
  std::map<int, SolidWalk> walks_;  ///< By solid
  std::vector<SolidCrossing> crossings_;
  std::vector<SolidBoundary> boundaries_;
};

}  // namespace

void resolveSolids(const Scene& scene, const Camera& camera, const GridTable& grids, SampleBuffer& samples) {
  if (!samples.crossings.empty()) SolidResolver(scene, camera, grids, samples).resolve();
}

}  // namespace tomales

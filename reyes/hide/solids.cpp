#include "reyes/hide/solids.h"

#include <map>
#include <tuple>

#include "reyes/hide/resolve.h"

namespace tomales {
namespace {

/// Greatest distance between surfaces that are coincident, as a share of the depth range of a micropolygon, which is
/// about a pixel wide: vertices are snapped to the lattice, and depths are rounded.
constexpr float kSlackOfCell = 4e-3f;
constexpr float kSideRounding = 1e-6f;

/// A sample that a cell covers.
struct Crossing {
  uint32_t lane;  ///< Index in SampleBuffer.
  int solid;
  float d;
  uint32_t cell;
};

class SolidResolver {
 public:
  SolidResolver(const Scene& scene, const Camera& camera, const GridTable& grids, SampleBuffer& samples)
      : scene_(scene), camera_(camera), grids_(grids), samples_(samples) {}

  void resolve() {
    const std::vector<Crossing> all = sorted();
    samples_.layers.beginGrid();
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
    const TransparentLayers& crossings = samples_.crossings;
    const auto lanes = static_cast<uint32_t>(samples_.lanes), words = static_cast<uint32_t>(crossings.wordsOfPixel());
    for (size_t i = 0; i < crossings.count(); ++i) {
      const TransparentLayer& layer = crossings.layer(i);
      const uint32_t first = layer.word / words * lanes + 64 * (layer.word % words);
      for (uint64_t left = layer.samples; left; left &= left - 1) {
        const auto s = static_cast<uint32_t>(std::countr_zero(left));
        const uint32_t cell = crossings.cells(i)[s];
        all.push_back({first + s, objectOf(cell).solid, crossings.depths(i)[s], cell});
      }
    }
    std::sort(all.begin(), all.end(), [this](const Crossing& p, const Crossing& q) {
      const auto key = [](const Crossing& c) { return std::tie(c.lane, c.solid, c.d); };
      return key(p) != key(q) ? key(p) < key(q) : grids_.precedes(p.cell, q.cell);
    });
    return all;
  }

  static bool sameLine(const Crossing& p, const Crossing& q) { return p.lane == q.lane && p.solid == q.solid; }

  SolidCrossing crossing(const Crossing& c) const {
    const GridTable::Entry& entry = grids_.of(c.cell);
    const Object& o = objectOf(c.cell);
    const SeenCell s =
        seenCell(entry, camera_, static_cast<int>(c.cell - entry.firstCell), samplePoint(samples_, c.lane));
    const vec2 ad(s.d - s.a), bc(s.c - s.b);
    // Raster y runs down: a cell that turns clockwise from u to v as seen has dPdu x dPdv towards the eye.
    const bool leaving = (ad.x * bc.y - ad.y * bc.x < 0) != (o.flipsNormal != o.turnedInSolid);
    const float extent = std::max({s.a.z, s.b.z, s.c.z, s.d.z}) - std::min({s.a.z, s.b.z, s.c.z, s.d.z});
    const float rounding = kSideRounding * std::abs(c.d);
    return {o.solidBlock, leaving, c.d, extent + rounding, kSlackOfCell * extent + rounding};
  }

  void resolveLine(std::span<const Crossing> line) {
    crossings_.clear();
    for (const Crossing& c : line) crossings_.push_back(crossing(c));
    const int solid = line.front().solid;
    const auto walk = walks_.try_emplace(solid, scene_.solids[static_cast<size_t>(solid)]).first;
    walk->second.boundaries(crossings_, boundaries_);
    for (const SolidBoundary& b : boundaries_)
      if (visible(line[b.crossing], b.entering) && compete(line[b.crossing])) return;
  }

  /// The surface of a solid has its own outside, whatever the orientation of its primitives. It is computed before
  /// clipping.
  bool visible(const Crossing& c, bool entering) const {
    const Attributes& a = *objectOf(c.cell).attributes;
    const SamplePoint sample = samplePoint(samples_, c.lane);
    return a.visibility.camera && (entering || a.sides == 2) && !camera_.clips(sample.at, sample.lens, c.d);
  }

  /// Returns true if it hides everything behind it.
  bool compete(const Crossing& c) {
    float& depth = samples_.depth[c.lane];
    if (c.d > depth) return false;
    if (!grids_.of(c.cell).raster->opaque) {
      const uint32_t lanes = static_cast<uint32_t>(samples_.lanes), s = c.lane % lanes;
      samples_.layers.add(samples_.wordOf(c.lane / lanes, s), s % 64, c.cell, c.d);
      samples_.layers.flush();
      return false;
    }
    uint32_t& owner = samples_.cell[c.lane];
    if (c.d < depth || grids_.precedes(c.cell, owner)) {
      depth = c.d;
      owner = c.cell;
    }
    return true;
  }

  const Scene& scene_;
  const Camera& camera_;
  const GridTable& grids_;
  SampleBuffer& samples_;
  std::map<int, SolidWalk> walks_;  ///< Indexed by solid.
  std::vector<SolidCrossing> crossings_;
  std::vector<SolidBoundary> boundaries_;
};

}  // namespace

void resolveSolids(const Scene& scene, const Camera& camera, const GridTable& grids, SampleBuffer& samples) {
  if (samples.crossings.count() > 0) SolidResolver(scene, camera, grids, samples).resolve();
}

}  // namespace tomales

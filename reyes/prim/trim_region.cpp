#include "reyes/prim/trim_region.h"

#include <fmt/format.h>

#include "reyes/prim/nurbs.h"

namespace tomales {
namespace {

/// Relative to the parameter square: a tenth of a pixel for 50,000 px of surface.
constexpr double kFlatness = 1.0 / (1 << 19);
constexpr int kMostHalvings = 16;
constexpr double kGap = 1e-4;  ///< Ends of curves no farther apart than this are joined without a warning.
constexpr size_t kMostSlabs = 256;

glm::dvec2 fromHomogeneous(const glm::dvec3& h) { return glm::dvec2(h) / h.z; }

/// Tells whether the control polygon stays near its chord. The curve lies in its hull.
bool isFlat(const std::vector<glm::dvec3>& c) {
  const glm::dvec2 a = fromHomogeneous(c.front()), chord = fromHomogeneous(c.back()) - a;
  const double length2 = glm::dot(chord, chord);
  for (size_t i = 1; i + 1 < c.size(); ++i) {
    const glm::dvec2 p = fromHomogeneous(c[i]) - a;
    const double along = length2 > 0 ? std::clamp(glm::dot(p, chord) / length2, 0.0, 1.0) : 0;
    if (glm::length(p - along * chord) > kFlatness) return false;
  }
  return true;
}

/// Appends the ends of the chords except the first, by de Casteljau's halving.
void flatten(std::vector<glm::dvec3> c, int halvings, std::vector<glm::dvec2>& out) {
  if (halvings == kMostHalvings || isFlat(c)) return out.push_back(fromHomogeneous(c.back()));
  std::vector<glm::dvec3> left;
  for (size_t last = c.size(); last > 0; --last) {
    left.push_back(c[0]);
    for (size_t i = 0; i + 1 < last; ++i) c[i] = 0.5 * (c[i] + c[i + 1]);
  }
  flatten(std::move(left), halvings + 1, out);
  flatten(std::move(c), halvings + 1, out);
}

std::vector<glm::dvec2> polylineOf(const TrimCurve& curve, const vec2& begin, const vec2& end, Problems& problems) {
  for (const vec3& h : curve.controls)
    if (!(h.z > 0)) throw PrimError("the weights of a trim curve are not positive");
  const size_t order = static_cast<size_t>(curve.line.order);
  const glm::dvec2 from(begin), size = glm::dvec2(end) - from;
  std::vector<glm::dvec2> out;
  for (const BezierSpan& span : bezierSpans(curve.line, "a trim curve", problems)) {
    std::vector<glm::dvec3> bezier(order, glm::dvec3(0));
    for (size_t k = 0; k < order; ++k) {
      for (size_t i = 0; i < order; ++i)
        bezier[k] += span.weights[k * order + i] * glm::dvec3(curve.controls[static_cast<size_t>(span.segment) + i]);
      bezier[k] = {(glm::dvec2(bezier[k]) - from * bezier[k].z) / size, bezier[k].z};
    }
    if (out.empty()) out.push_back(fromHomogeneous(bezier.front()));
    flatten(std::move(bezier), 0, out);
  }
  return out;
}

}  // namespace

TrimRegion::TrimRegion(const TrimLoops& trim, const vec2& begin, const vec2& end, Problems& problems)
    : keepsInside_(trim.keepsInside) {
  for (size_t k = 0; k < trim.loops.size(); ++k) addLoop(trim.loops[k], k, begin, end, problems);
  sortIntoSlabs();
}

void TrimRegion::addLoop(const std::vector<TrimCurve>& loop, size_t number, const vec2& begin, const vec2& end,
                         Problems& problems) {
  Points polygon;
  bool gaps = false;
  for (const TrimCurve& curve : loop) {
    const Points line = polylineOf(curve, begin, end, problems);
    gaps |= !polygon.empty() && glm::distance(polygon.back(), line.front()) > kGap;
    polygon.insert(polygon.end(), line.begin(), line.end());
  }
  if (polygon.empty()) return;
  gaps |= glm::distance(polygon.back(), polygon.front()) > kGap;
  if (gaps) problems.push_back(fmt::format("loop {} of its trim curves has gaps; straight lines close them", number));
  // Points are rounded once, so that successive segments share their ends to the bit and no ray slips between them.
  for (size_t i = 0; i < polygon.size(); ++i) {
    const vec2 a(polygon[i]), b(polygon[(i + 1) % polygon.size()]);
    if (a != b) segments_.push_back({a, b});
  }
}

void TrimRegion::sortIntoSlabs() {
  slabs_.resize(std::clamp<size_t>(segments_.size() / 4, 1, kMostSlabs));
  for (size_t i = 0; i < segments_.size(); ++i) {
    const auto [v0, v1] = std::minmax(segments_[i].a.y, segments_[i].b.y);
    const Slabs range = slabsOf(v0, v1);
    for (size_t s = range.first; s <= range.last; ++s) slabs_[s].push_back(static_cast<uint32_t>(i));
  }
}

TrimRegion::Slabs TrimRegion::slabsOf(float v0, float v1) const {
  const float count = static_cast<float>(slabs_.size());
  const auto slab = [&](float v) { return v > 0 ? static_cast<size_t>(std::min(v * count, count - 1)) : size_t{0}; };
  return {slab(v0), slab(v1)};
}

/// Uses the parity of the crossings of a ray towards greater u (RISpec 3.2, TrimCurve: the odd winding rule).
bool TrimRegion::keeps(const vec2& at) const {
  bool inside = false;
  for (const uint32_t i : slabs_[slabsOf(at.y, at.y).first]) {
    const Segment& s = segments_[i];
    if ((s.a.y <= at.y) == (s.b.y <= at.y)) continue;
    const double t = (double{at.y} - s.a.y) / (double{s.b.y} - s.a.y);
    inside ^= s.a.x + t * (double{s.b.x} - s.a.x) > at.x;
  }
  return inside == keepsInside_;
}

bool TrimRegion::touches(const Segment& s, const vec2& lo, const vec2& hi) const {
  if (glm::any(glm::lessThan(glm::max(s.a, s.b), lo)) || glm::any(glm::greaterThan(glm::min(s.a, s.b), hi)))
    return false;
  // The rectangle lies on one side of the line if its corners do.
  const glm::dvec2 d = glm::dvec2(s.b) - glm::dvec2(s.a);
  int left = 0, right = 0;
  for (const vec2& corner : {lo, hi, vec2(lo.x, hi.y), vec2(hi.x, lo.y)}) {
    const glm::dvec2 e = glm::dvec2(corner) - glm::dvec2(s.a);
    const double side = d.x * e.y - d.y * e.x;
    left += side > 0;
    right += side < 0;
  }
  return left < 4 && right < 4;
}

Kept TrimRegion::kept(const vec2& lo, const vec2& hi) const {
  const Slabs range = slabsOf(lo.y, hi.y);
  for (size_t slab = range.first; slab <= range.last; ++slab)
    for (const uint32_t i : slabs_[slab])
      if (touches(segments_[i], lo, hi)) return Kept::Part;
  return keeps(0.5f * (lo + hi)) ? Kept::All : Kept::None;
}

}  // namespace tomales

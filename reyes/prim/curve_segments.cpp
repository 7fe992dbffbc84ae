#include "reyes/prim/curve_segments.h"

#include <fmt/format.h>

#include "reyes/prim/facing.h"
#include "reyes/prim/primvars.h"

namespace tomales {
namespace {

template <class T>
Cubic<T> straight(const T& a, const T& b) {
  return {a, a + (b - a) / 3.0f, b + (a - b) / 3.0f, b};
}

struct CurveLayout {
  std::vector<CurveSegment> segments;
  PrimvarCounts counts;
};

class CurveLayoutMaker {
 public:
  CurveLayoutMaker(bool cubic, int step, bool periodic)
      : span_(cubic ? 4 : 2), step_(cubic ? step : 1), periodic_(periodic) {}

  CurveLayout make(const std::vector<int>& vertexCounts) {
    if (step_ < 1) throw PrimError(fmt::format("the step of the basis is {}", step_));
    for (const int count : vertexCounts) add(count);
    out_.counts = {vertexCounts.size(), corner_, vertex_, corner_};
    return std::move(out_);
  }

 private:
  void add(int count) {
    const int rest = periodic_ ? count : count - span_;
    if (count < span_ || rest % step_ != 0)
      throw PrimError(fmt::format("curve {} has {} vertices, which make no whole number of segments", curve_, count));
    const uint32_t n = static_cast<uint32_t>(count), segments = static_cast<uint32_t>(rest / step_) + !periodic_;
    const uint32_t corners = segments + !periodic_;
    for (uint32_t k = 0; k < segments; ++k) {
      CurveSegment s{curve_,
                     k,
                     segments,
                     {corner_ + k, corner_ + (k + 1) % corners},
                     {},
                     !periodic_ && k == 0,
                     !periodic_ && k + 1 == segments};
      for (uint32_t i = 0; i < 4; ++i)
        s.controls[i] =
            vertex_ + (k * static_cast<uint32_t>(step_) + std::min(i, static_cast<uint32_t>(span_ - 1))) % n;
      out_.segments.push_back(s);
    }
    ++curve_;
    corner_ += corners;
    vertex_ += n;
  }

  const int span_, step_;
  const bool periodic_;
  uint32_t curve_ = 0, corner_ = 0, vertex_ = 0;
  CurveLayout out_;
};

}  // namespace

// Computes the piece by blossoming.
Cubic<vec4> piece(const Cubic<vec4>& c, float t0, float t1) {
  const auto blossom = [&](float r, float s, float t) {
    const vec4 a = glm::mix(c[0], c[1], r), b = glm::mix(c[1], c[2], r), d = glm::mix(c[2], c[3], r);
    return glm::mix(glm::mix(a, b, s), glm::mix(b, d, s), t);
  };
  return {blossom(t0, t0, t0), blossom(t0, t0, t1), blossom(t0, t1, t1), blossom(t1, t1, t1)};
}

CurveSegments::CurveSegments(bool cubic, const Basis& basis, const std::vector<int>& vertexCounts, bool periodic,
                             const ParamList& params, Problems& problems)
    : cubic_(cubic), toBezier_(bezierFrom(basis)) {
  if (vertexCounts.empty()) throw PrimError("there are no curves");
  size_t vertices = 0;
  for (const int count : vertexCounts) vertices += static_cast<size_t>(std::max(0, count));
  const std::vector<vec3> points = takePositions(params, Count::Exactly, vertices, problems);
  CurveLayout layout = CurveLayoutMaker(cubic, basis.step, periodic).make(vertexCounts);
  segments_ = std::move(layout.segments);
  primvars = takePrimvars(params, layout.counts, problems);
  const Primvar width = widthOf(primvars);
  const std::vector<Cubic<vec3>> centers = along({"P", Storage::Vertex, ValueType::Point, 3, {}}, &points[0].x);
  const std::vector<Cubic<vec3>> widths = along(width);
  lines_.resize(segments_.size());
  for (size_t k = 0; k < lines_.size(); ++k)
    for (size_t i = 0; i < 4; ++i) lines_[k][i] = vec4(centers[k][i], widths[k][i].x);
  if (!cubic_) findMitres();
}

void CurveSegments::direction(size_t k, float v, vec3& along, vec3& slope) const {
  along = vec3(slopeAt(lines_[k], v));
  slope = vec3(curvatureAt(lines_[k], v));
  if (!cubic_) {
    along = glm::mix(mitres_[k][0], mitres_[k][1], v);
    slope = mitres_[k][1] - mitres_[k][0];
  }
  if (along == vec3(0)) along = vec3(slopeAt(lines_[k], v + (0.5f - v) * 1e-2f));
}

std::vector<Cubic<vec3>> CurveSegments::along(const Primvar& var) const { return along(var, var.values.data()); }

std::vector<Cubic<vec3>> CurveSegments::along(const Primvar& var, const float* values) const {
  std::vector<Cubic<vec3>> out(segments_.size());
  for (size_t s = 0; s < out.size(); ++s)
    for (int c = 0; c < std::min(3, var.width); ++c) {
      const Cubic<float> component = componentAlong(var, values, c, segments_[s]);
      for (size_t k = 0; k < 4; ++k) out[s][k][c] = component[k];
    }
  return out;
}

void CurveSegments::interpolate(const Primvar& var, size_t k, int n, const float* v, float* out, int stride) const {
  for (int c = 0; c < var.width; ++c) {
    const Cubic<float> values = componentAlong(var, var.values.data(), c, segments_[k]);
    for (int i = 0; i < n; ++i) out[static_cast<ptrdiff_t>(c) * stride + i] = valueAt(values, v[i]);
  }
}

/// Bezier values of one component of a variable along a segment.
Cubic<float> CurveSegments::componentAlong(const Primvar& var, const float* values, int component,
                                           const CurveSegment& s) const {
  const auto at = [&](size_t element) {
    return values[element * static_cast<size_t>(var.width) + static_cast<size_t>(component)];
  };
  if (var.storage == Storage::Constant) return straight(at(0), at(0));
  if (var.storage == Storage::Uniform) return straight(at(s.curve), at(s.curve));
  if (var.storage != Storage::Vertex) return straight(at(s.corners[0]), at(s.corners[1]));
  if (!cubic_) return straight(at(s.controls[0]), at(s.controls[1]));
  Cubic<float> out{};
  for (size_t k = 0; k < 4; ++k)
    for (size_t i = 0; i < 4; ++i) out[k] += toBezier_[k][i] * at(s.controls[i]);
  return out;
}

vec3 CurveSegments::chord(size_t k) const { return normalizeOr(vec3(lines_[k][3]) - vec3(lines_[k][0]), vec3(0)); }

void CurveSegments::findMitres() {
  mitres_.resize(segments_.size());
  for (size_t k = 0; k < segments_.size(); ++k) {
    const CurveSegment& s = segments_[k];
    const vec3 here = chord(k);
    mitres_[k] = {s.first ? here : normalizeOr(here + chord(neighbour(k, false)), here),
                  s.last ? here : normalizeOr(here + chord(neighbour(k, true)), here)};
  }
}

size_t CurveSegments::bytes() const {
  return segments_.capacity() * sizeof(segments_[0]) + lines_.capacity() * sizeof(lines_[0]) +
         mitres_.capacity() * sizeof(mitres_[0]);
}

}  // namespace tomales

// Curves as ribbons (RISpec 3.2, Curves): u across, v along. Every segment is a cubic Bezier curve with a
// width.
#include <fmt/format.h>

#include "reyes/prim/bicubic.h"
#include "reyes/prim/facing.h"
#include "reyes/prim/interpolation.h"
#include "reyes/prim/primvars.h"

namespace tomales {
namespace {

template <class T>
using Cubic = std::array<T, 4>;

template <class T>
T valueAt(const Cubic<T>& c, float t) {
  const float s = 1 - t;
  return s * s * s * c[0] + 3 * s * s * t * c[1] + 3 * s * t * t * c[2] + t * t * t * c[3];
}
template <class T>
T slopeAt(const Cubic<T>& c, float t) {
  const float s = 1 - t;
  return 3.0f * (s * s * (c[1] - c[0]) + 2 * s * t * (c[2] - c[1]) + t * t * (c[3] - c[2]));
}
template <class T>
T curvatureAt(const Cubic<T>& c, float t) {
  return 6.0f * ((1 - t) * (c[2] - 2.0f * c[1] + c[0]) + t * (c[3] - 2.0f * c[2] + c[1]));
}
template <class T>
Cubic<T> straight(const T& a, const T& b) {
  return {a, a + (b - a) / 3.0f, b + (a - b) / 3.0f, b};
}
/// The piece over [t0, t1] (blossoming).
Cubic<vec4> piece(const Cubic<vec4>& c, float t0, float t1) {
  const auto blossom = [&](float r, float s, float t) {
    const vec4 a = glm::mix(c[0], c[1], r), b = glm::mix(c[1], c[2], r), d = glm::mix(c[2], c[3], r);
    return glm::mix(glm::mix(a, b, s), glm::mix(b, d, s), t);
  };
  return {blossom(t0, t0, t0), blossom(t0, t0, t1), blossom(t0, t1, t1), blossom(t1, t1, t1)};
}

struct Segment {
  uint32_t curve, number, of;        ///< Which segment of how many of its curve.
  std::array<uint32_t, 2> corners;   ///< Numbers of its varying values,
  std::array<uint32_t, 4> controls;  ///< and of its vertices; a line has two.
  bool first, last;                  ///< At a loose end.
};

struct Layout {
  std::vector<Segment> segments;
  PrimvarCounts counts;
};

class LayoutMaker {
 public:
  LayoutMaker(bool cubic, int step, bool periodic)
      : span_(cubic ? 4 : 2), step_(cubic ? step : 1), periodic_(periodic) {}

  Layout make(const std::vector<int>& vertexCounts) {
    if (step_ < 1) throw PrimError(fmt::format("the step of the basis is {}", step_));
    for (const int count : vertexCounts) add(count);
    out_.counts = {vertexCounts.size(), corner_, vertex_, corner_};
    return std::move(out_);
  }

 private:
  void add(int count) {
    const int rest = periodic_ ? count : count - span_;
    if (count < span_ || rest % step_ != 0)
      throw PrimError(
          fmt::format("curve {} has {} vertices, which make no whole number of segments", curve_, count));
    const uint32_t n = static_cast<uint32_t>(count),
                   segments = static_cast<uint32_t>(rest / step_) + !periodic_;
    const uint32_t corners = segments + !periodic_;
    for (uint32_t k = 0; k < segments; ++k) {
      Segment s{curve_,
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
    ++curve_, corner_ += corners, vertex_ += n;
  }

  const int span_, step_;
  const bool periodic_;
  uint32_t curve_ = 0, corner_ = 0, vertex_ = 0;
  Layout out_;
};

class Curves : public Prim {
 public:
  Curves(bool cubic, const Basis& basis, Layout layout, std::vector<vec3> points,
         std::vector<Primvar> primvars)
      : Prim(std::move(primvars)),
        cubic_(cubic),
        toBezier_(bezierFrom(basis)),
        segments_(std::move(layout.segments)) {
    const Primvar width = widthOf(primvars_);
    const Primvar* normals = normalsOf(primvars_);
    for (const Segment& s : segments_) {
      const Cubic<vec3> center = along({"P", Storage::Vertex, ValueType::Point, 3, {}}, &points[0].x, s);
      const Cubic<vec3> across = along(width, width.values.data(), s);
      auto& c = centers_.emplace_back();
      for (int k = 0; k < 4; ++k) c[k] = vec4(center[k], across[k].x);
      if (normals) normals_.push_back(along(*normals, normals->values.data(), s));
    }
    if (!cubic_) findMitres();
  }

  std::shared_ptr<const Prim> facing(const vec3& eye, const vec3& forward, bool perspective) const override {
    if (!normals_.empty()) return nullptr;
    auto turned = std::make_shared<Curves>(*this);
    turned->eye_ = {eye, forward, perspective};
    return turned;
  }

  uint32_t patchCount() const override { return static_cast<uint32_t>(segments_.size()); }
  PatchInfo info(uint32_t patch) const override {
    const Segment& s = segments_[patch];
    return {false,
            static_cast<uint8_t>(kEdgeU0 | kEdgeU1 | (s.first ? kEdgeV0 : 0) | (s.last ? kEdgeV1 : 0))};
  }

  Bound3 bound(uint32_t patch, const UvRect& r) const override {
    Bound3 line;
    float width = 0;
    for (const vec4& c : piece(centers_[patch], r.v0, r.v1))
      line.extend(vec3(c)), width = std::max(width, c.w);
    const Bound3 ribbon = line.grown(width * std::max(std::abs(r.u0 - 0.5f), std::abs(r.u1 - 0.5f)));
    return paddedForRounding(ribbon, ribbon);
  }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    Cross c{};
    for (int i = 0; i < n; ++i) {
      if (i == 0 || v[i] != v[i - 1]) c = crossAt(patch, v[i]);  // lattices run across the ribbon
      const float x = u[i] - 0.5f;
      const vec3 p = c.center + x * c.width * c.side, du = c.width * c.side,
                 dv = c.slope + x * (c.widthSlope * c.side + c.width * c.sideSlope);
      out.px[i] = p.x, out.py[i] = p.y, out.pz[i] = p.z;
      out.dux[i] = du.x, out.duy[i] = du.y, out.duz[i] = du.z;
      out.dvx[i] = dv.x, out.dvy[i] = dv.y, out.dvz[i] = dv.z;
      const vec3 normal = cross(du, dv);
      setNormal(out, i, glm::length(normal) > 1e-6f * glm::length(du) * glm::length(dv) ? normal : c.up);
    }
  }

  /// RISpec: v runs along the whole curve.
  void surfaceParameters(uint32_t patch, int n, const float* u, const float* v, float* su,
                         float* sv) const override {
    const Segment& s = segments_[patch];
    std::copy_n(u, n, su);
    for (int i = 0; i < n; ++i) sv[i] = (static_cast<float>(s.number) + v[i]) / static_cast<float>(s.of);
  }

  void interpolate(uint32_t patch, int index, int n, const float*, const float* v, float* out,
                   int stride) const override {
    const Primvar& var = primvars_[static_cast<size_t>(index)];
    for (int c = 0; c < var.width; ++c) {
      const Cubic<float> values = componentAlong(var, var.values.data(), c, segments_[patch]);
      for (int i = 0; i < n; ++i) out[static_cast<ptrdiff_t>(c) * stride + i] = valueAt(values, v[i]);
    }
  }

 private:
  /// The ribbon's cross section: unit vectors `side` and, towards where it faces, `up`; slopes are by v.
  struct Cross {
    vec3 center, slope, side, sideSlope, up;
    float width, widthSlope;
  };

  Cross crossAt(uint32_t patch, float v) const {
    const Cubic<vec4>& line = centers_[patch];
    const vec4 value = valueAt(line, v), slope = slopeAt(line, v);
    Cross c{vec3(value), vec3(slope), {}, {}, {}, value.w, slope.w};
    const bool oriented = !normals_.empty();
    const vec3 up = oriented ? valueAt(normals_[patch], v) : eye_.towards(c.center);
    const vec3 upSlope = oriented ? slopeAt(normals_[patch], v) : eye_.perspective ? -c.slope : vec3(0);
    vec3 along = c.slope, alongSlope = vec3(curvatureAt(line, v));
    if (!cubic_)
      along = glm::mix(mitres_[patch][0], mitres_[patch][1], v),
      alongSlope = mitres_[patch][1] - mitres_[patch][0];
    if (along == vec3(0)) along = vec3(slopeAt(line, v + (0.5f - v) * 1e-2f));
    const vec3 across = cross(along, up), acrossSlope = cross(alongSlope, up) + cross(along, upSlope);
    const float length = glm::length(across);
    if (length > 1e-6f * glm::length(along) * glm::length(up)) {
      c.side = across / length;
      c.sideSlope = (acrossSlope - c.side * dot(c.side, acrossSlope)) / length;
    } else {  // seen along its own direction
      vec3 other;
      orthonormalBasis(normalizeOr(up, vec3(0, 0, 1)), c.side, other);
      c.sideSlope = vec3(0);
    }
    c.up = normalizeOr(up - c.side * dot(c.side, up), vec3(0, 0, 1));
    return c;
  }

  /// Bezier values of one component of a variable along a segment.
  Cubic<float> componentAlong(const Primvar& var, const float* values, int component,
                              const Segment& s) const {
    const auto at = [&](uint32_t element) {
      return values[static_cast<size_t>(element) * var.width + component];
    };
    if (var.storage == Storage::Constant) return straight(at(0), at(0));
    if (var.storage == Storage::Uniform) return straight(at(s.curve), at(s.curve));
    if (var.storage != Storage::Vertex) return straight(at(s.corners[0]), at(s.corners[1]));
    if (!cubic_) return straight(at(s.controls[0]), at(s.controls[1]));
    Cubic<float> out{};
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 4; ++i) out[k] += toBezier_[k][i] * at(s.controls[i]);
    return out;
  }

  /// Its first three components.
  Cubic<vec3> along(const Primvar& var, const float* values, const Segment& s) const {
    Cubic<vec3> out{};
    for (int c = 0; c < std::min(3, var.width); ++c) {
      const Cubic<float> component = componentAlong(var, values, c, s);
      for (int k = 0; k < 4; ++k) out[k][c] = component[k];
    }
    return out;
  }

  vec3 directionOf(size_t segment) const {
    return normalizeOr(vec3(centers_[segment][3]) - vec3(centers_[segment][0]), vec3(0));
  }

  /// At a vertex of a polyline, the mean of the two directions, so that the ribbons meet.
  void findMitres() {
    mitres_.resize(segments_.size());
    for (size_t k = 0; k < segments_.size(); ++k) {
      const Segment& s = segments_[k];
      const size_t begin = k - s.number, before = begin + (s.number + s.of - 1) % s.of,
                   after = begin + (s.number + 1) % s.of;
      const vec3 here = directionOf(k);
      mitres_[k] = {s.first ? here : normalizeOr(here + directionOf(before), here),
                    s.last ? here : normalizeOr(here + directionOf(after), here)};
    }
  }

  size_t shapeBytes() const override { return bytesOf(segments_) + bytesOf(centers_) + bytesOf(normals_) + bytesOf(mitres_); }
  bool cubic_;
  ToBezier toBezier_;
  std::vector<Segment> segments_;
  std::vector<Cubic<vec4>> centers_;         // with the width
  std::vector<Cubic<vec3>> normals_;         // empty: it faces the eye
  std::vector<std::array<vec3, 2>> mitres_;  // of polylines
  Eye eye_;
};

}  // namespace

PrimPtr makeCurves(bool cubic, const Basis& basis, const std::vector<int>& vertexCounts, bool periodic,
                   const ParamList& params, Problems& problems) {
  if (vertexCounts.empty()) throw PrimError("there are no curves");
  size_t vertices = 0;
  for (const int count : vertexCounts) vertices += static_cast<size_t>(std::max(0, count));
  std::vector<vec3> points = takePositions(params, vertices, true, problems);
  Layout layout = LayoutMaker(cubic, basis.step, periodic).make(vertexCounts);
  std::vector<Primvar> primvars = takePrimvars(params, layout.counts, problems);
  return std::make_shared<Curves>(cubic, basis, std::move(layout), std::move(points), std::move(primvars));
}

}  // namespace tomales

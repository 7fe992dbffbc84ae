// Curves as ribbons (RISpec 3.2, Curves): u across and v along.
#include "reyes/prim/curve_segments.h"
#include "reyes/prim/facing.h"
#include "reyes/prim/interpolation.h"

namespace tomales {
namespace {

class Ribbons : public Prim {
 public:
  explicit Ribbons(CurveSegments segments)
      : Prim(std::move(segments.primvars)), segments_(std::move(segments)) {
    if (const Primvar* normals = normalsOf(primvars_)) normals_ = segments_.along(*normals);
  }

  std::shared_ptr<const Prim> facing(const vec3& eye, const vec3& forward, bool perspective) const override {
    if (!normals_.empty()) return nullptr;
    auto turned = std::make_shared<Ribbons>(*this);
    turned->eye_ = {eye, forward, perspective};
    return turned;
  }

  uint32_t patchCount() const override { return segments_.count(); }
  PatchInfo info(uint32_t patch) const override {
    const CurveSegment& s = segments_[patch];
    return {false,
            static_cast<uint8_t>(kEdgeU0 | kEdgeU1 | (s.first ? kEdgeV0 : 0) | (s.last ? kEdgeV1 : 0))};
  }

  Bound3 bound(uint32_t patch, const UvRect& r) const override {
    Bound3 line;
    float width = 0;
    for (const vec4& c : piece(segments_.line(patch), r.v0, r.v1))
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
      setFrame(out, i, p, du, dv);
      const vec3 normal = cross(du, dv);
      const bool turns = dot(normal, normal) > 1e-12f * dot(du, du) * dot(dv, dv);
      setNormal(out, i, turns ? normal : normalizeOr(c.up - c.side * dot(c.side, c.up), vec3(0, 0, 1)));
    }
  }

  /// RISpec: v runs along the whole curve.
  void surfaceParameters(uint32_t patch, int n, const float* u, const float* v, float* su,
                         float* sv) const override {
    const CurveSegment& s = segments_[patch];
    std::copy_n(u, n, su);
    for (int i = 0; i < n; ++i) sv[i] = (static_cast<float>(s.number) + v[i]) / static_cast<float>(s.of);
  }

  void interpolate(uint32_t patch, int index, int n, const float*, const float* v, float* out,
                   int stride) const override {
    segments_.interpolate(primvars_[static_cast<size_t>(index)], patch, n, v, out, stride);
  }

 private:
  /// The ribbon's cross section: the unit vector `side`, and `up`, towards where it faces; slopes are by v.
  struct Cross {
    vec3 center, slope, side, sideSlope, up;
    float width, widthSlope;
  };

  Cross crossAt(uint32_t patch, float v) const {
    const Cubic<vec4>& line = segments_.line(patch);
    const vec4 value = valueAt(line, v), slope = slopeAt(line, v);
    Cross c{vec3(value), vec3(slope), {}, {}, {}, value.w, slope.w};
    const bool oriented = !normals_.empty();
    const vec3 up = c.up = oriented ? valueAt(normals_[patch], v) : eye_.towards(c.center);
    const vec3 upSlope = oriented ? slopeAt(normals_[patch], v) : eye_.perspective ? -c.slope : vec3(0);
    vec3 along, alongSlope;
    segments_.direction(patch, v, along, alongSlope);
    const vec3 across = cross(along, up), acrossSlope = cross(alongSlope, up) + cross(along, upSlope);
    if (dot(across, across) > 1e-12f * dot(along, along) * dot(up, up)) {
      const float length = glm::length(across);
      c.side = across / length;
      c.sideSlope = (acrossSlope - c.side * dot(c.side, acrossSlope)) / length;
    } else {  // seen along its own direction
      vec3 other;
      orthonormalBasis(normalizeOr(up, vec3(0, 0, 1)), c.side, other);
      c.sideSlope = vec3(0);
    }
    return c;
  }

  size_t shapeBytes() const override { return segments_.bytes() + bytesOf(normals_); }
  CurveSegments segments_;
  std::vector<Cubic<vec3>> normals_;  // empty: it faces the eye
  Eye eye_;
};

}  // namespace

PrimPtr makeCurves(bool cubic, const Basis& basis, const std::vector<int>& vertexCounts, bool periodic,
                   const ParamList& params, Problems& problems) {
  return std::make_shared<Ribbons>(CurveSegments(cubic, basis, vertexCounts, periodic, params, problems));
}

}  // namespace tomales

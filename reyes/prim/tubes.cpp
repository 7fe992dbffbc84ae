// Curves as tubes (Attribute "dice" "roundcurve"): u around and v along. Loose ends are closed by flat disks, which are
// patches of their own, u around and v from the rim to the middle. Segments of a polyline are cylinders that meet in
// mitres.
#include "reyes/prim/curve_segments.h"
#include "reyes/prim/interpolation.h"
#include "reyes/prim/revolution.h"
#include "reyes/prim/sampled_bound.h"

namespace tomales {
namespace {

/// Returns a unit vector across `along`: the rotation of z onto that direction, applied to x (J. R. Frisvad 2012). It
/// is continuous over all directions but one, which is rare among curves, so moving tubes keep their seams.
vec3 acrossOf(const vec3& along) {
  static const mat3 kTurn = [] {
    const vec3 z = glm::normalize(vec3(0.31f, 0.57f, 0.76f));
    const vec3 x = glm::normalize(cross(vec3(0, 1, 0), z));
    return mat3(x, cross(z, x), z);
  }();
  const vec3 n = glm::transpose(kTurn) * along;
  if (n.z < -0.99999f) return kTurn * vec3(0, -1, 0);
  const float a = 1 / (1 + n.z);
  return kTurn * vec3(1 - n.x * n.x * a, -n.x * n.y * a, -n.x);
}

class Tubes : public Prim {
 public:
  explicit Tubes(CurveSegments segments) : Prim(std::move(segments.primvars)), segments_(std::move(segments)) {
    for (uint32_t k = 0; k < segments_.count(); ++k) {
      const CurveSegment& s = segments_[k];
      if (s.first && segments_.line(k)[0].w > 0) ends_.push_back({k, false});
      if (s.last && segments_.line(k)[3].w > 0) ends_.push_back({k, true});
    }
    findSides();
  }

  uint32_t patchCount() const override { return segments_.count() + static_cast<uint32_t>(ends_.size()); }
  PatchInfo info(uint32_t) const override { return {.openEdges = 0}; }

  Bound3 bound(uint32_t patch, const UvRect& r) const override {
    const End* end = endOf(patch);
    const uint32_t segment = end ? end->segment : patch;
    const float v = end && end->last ? 1.0f : 0.0f;
    Bound3 line;
    float width = 0;
    for (const vec4& c : end ? piece(segments_.line(segment), v, v) : piece(segments_.line(segment), r.v0, r.v1)) {
      line.extend(vec3(c));
      width = std::max(width, c.w);
    }
    const bool around = r.u0 <= 0 && r.u1 >= 1;
    const float mitred =
        segments_.cubic() || end ? 1 : std::max(joints_[segment][0].longer, joints_[segment][1].longer);
    const Bound3 whole = line.grown((around ? kMostInflation : 1.0f) * mitred * width / 2);
    if (around) return paddedForRounding(whole, whole);
    const Bound3 sampled = boundOfSamples(r, [&](float a, float b) {
      vec3 p, du, dv, n;
      at(patch, a, b, p, du, dv, n);
      return p;
    });
    return paddedForRounding({glm::max(whole.lo, sampled.lo), glm::min(whole.hi, sampled.hi)}, whole);
  }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    for (int i = 0; i < n; ++i) {
      vec3 p, du, dv, normal;
      at(patch, u[i], v[i], p, du, dv, normal);
      setFrame(out, i, p, du, dv);
      setNormal(out, i, normal);
    }
  }

  /// A regular polygon of nu corners is on average as wide as its circle (Cauchy: perimeter over pi) if its corners are
  /// moved outwards.
  void evaluateLattice(uint32_t patch, int nu, int nv, const float* u, const float* v,
                       SurfacePoints out) const override {
    evaluate(patch, (nu + 1) * (nv + 1), u, v, out);
    const float angle = kPi / static_cast<float>(nu);
    const float more = nu < 3 ? kMostInflation - 1 : angle / std::sin(angle) - 1;
    for (int i = 0; i < (nu + 1) * (nv + 1); ++i) {
      const vec3 center = centerOf(patch, v[i]);
      out.px[i] += more * (out.px[i] - center.x);
      out.py[i] += more * (out.py[i] - center.y);
      out.pz[i] += more * (out.pz[i] - center.z);
    }
  }

  void surfaceParameters(uint32_t patch, int n, const float* u, const float* v, float* su, float* sv) const override {
    const End* end = endOf(patch);
    const CurveSegment& s = segments_[end ? end->segment : patch];
    std::copy_n(u, n, su);
    for (int i = 0; i < n; ++i)
      sv[i] = end ? end->last : (static_cast<float>(s.number) + v[i]) / static_cast<float>(s.of);
  }

  void interpolate(uint32_t patch, int index, int n, const float*, const float* v, float* out,
                   int stride) const override {
    const End* end = endOf(patch);
    const Primvar& var = primvars_[static_cast<size_t>(index)];
    if (!end) return segments_.interpolate(var, patch, n, v, out, stride);
    const float at = end->last;
    std::vector<float> value(static_cast<size_t>(var.width));
    segments_.interpolate(var, end->segment, 1, &at, value.data(), 1);
    repeatElement(value.data(), var.width, n, out, stride);
  }

 private:
  static constexpr float kMostInflation = 1.21f;  ///< The inflation of a triangle.
  static constexpr int kSides = 4;  ///< Parts of a segment between the sides that double reflection computes.

  struct End {
    uint32_t segment;
    bool last;
  };
  const End* endOf(uint32_t patch) const {
    return patch < segments_.count() ? nullptr : &ends_[patch - segments_.count()];
  }

  vec3 centerOf(uint32_t patch, float v) const {
    const End* end = endOf(patch);
    return vec3(valueAt(segments_.line(end ? end->segment : patch), end ? static_cast<float>(end->last) : v));
  }

  /// The joint of two cylinders. It turns a vector across one of them, in the plane of the bend, to be across the mean
  /// of both directions, and lengthens it by `longer`. A zero axis means that they are in line.
  struct Joint {
    vec3 axis{0}, inPlane{0}, inMitre{0};
    float longer = 1;
    vec3 operator()(const vec3& out) const {
      return axis == vec3(0) ? out : axis * dot(axis, out) + longer * dot(inPlane, out) * inMitre;
    }
  };
  static Joint jointOf(const vec3& chord, const vec3& mitre) {
    constexpr float kMostLonger = 3;
    const vec3 axis = cross(chord, mitre);
    if (!(glm::length(axis) > 1e-4f)) return {};
    Joint j{glm::normalize(axis), {}, {}, std::min(1 / std::max(dot(chord, mitre), 1e-4f), kMostLonger)};
    j.inPlane = cross(j.axis, chord);
    j.inMitre = cross(j.axis, mitre);
    return j;
  }

  /// A unit vector across the curve, another, and the direction; slopes are derivatives by v.
  struct Frame {
    vec3 side, up, along, sideSlope, upSlope;
  };

  Frame frameAt(uint32_t segment, float v) const {
    vec3 along, alongSlope;
    segments_.direction(segment, v, along, alongSlope);
    const float length = glm::length(along), x = v * kSides;
    const size_t k = static_cast<size_t>(std::min(static_cast<int>(x), kSides - 1));
    const std::array<vec3, kSides + 1>& sides = sides_[segment];
    if (!(length > 0)) return {sides[0], {}, {}, {}, {}};
    Frame f;
    f.along = along / length;
    const vec3 turn = (alongSlope - f.along * dot(f.along, alongSlope)) / length;
    const vec3 wanted = glm::mix(sides[k], sides[k + 1], x - static_cast<float>(k)),
               wantedSlope = float{kSides} * (sides[k + 1] - sides[k]);
    const vec3 across = wanted - f.along * dot(f.along, wanted);
    const vec3 acrossSlope =
        wantedSlope - turn * dot(f.along, wanted) - f.along * (dot(turn, wanted) + dot(f.along, wantedSlope));
    const float acrossLength = glm::length(across);
    if (acrossLength > 1e-4f) {
      f.side = across / acrossLength;
      f.sideSlope = (acrossSlope - f.side * dot(f.side, acrossSlope)) / acrossLength;
    } else {  // a cusp
      f.side = acrossOf(f.along);
      f.sideSlope = vec3(0);
    }
    f.up = cross(f.along, f.side);
    f.upSlope = cross(turn, f.side) + cross(f.along, f.sideSlope);
    return f;
  }

  void at(uint32_t patch, float u, float v, vec3& p, vec3& du, vec3& dv, vec3& normal) const {
    const End* end = endOf(patch);
    const uint32_t segment = end ? end->segment : patch;
    const float along = end ? static_cast<float>(end->last) : v;
    const Cubic<vec4>& line = segments_.line(segment);
    const vec4 value = valueAt(line, along), slope = slopeAt(line, along);
    const Frame f = frameAt(segment, along);
    float sine, cosine;
    sinCosTurns(0, end && !end->last ? -1.0f : 1.0f, 1, &u, &sine, &cosine);
    const float turn = end && !end->last ? -2 * kPi : 2 * kPi;
    const vec3 out = cosine * f.side + sine * f.up, around = turn * (cosine * f.up - sine * f.side);
    if (end) {
      // Seen from outside the disk runs around the other way than the tube.
      const float radius = 0.5f * value.w * (1 - v);
      p = vec3(value) + radius * out;
      du = radius * around;
      dv = -0.5f * value.w * out;
      normal = end->last ? f.along : -f.along;
    } else if (!segments_.cubic()) {
      const auto onRim = [&](size_t k, const vec3& x) {
        const vec3 side = sides_[segment][k * size_t{kSides}];
        return 0.5f * line[k * size_t{3}].w *
               joints_[segment][k](x.x * side + x.y * cross(segments_.chord(segment), side));
      };
      const vec3 x(cosine, sine, 0), byU(-turn * sine, turn * cosine, 0);
      const vec3 a = onRim(0, x), b = onRim(1, x);
      p = vec3(value) + glm::mix(a, b, v);
      du = glm::mix(onRim(0, byU), onRim(1, byU), v);
      dv = vec3(slope) + b - a;
      normal = cross(du, dv);
      if (!(glm::length(normal) > 1e-4f * glm::length(du) * glm::length(dv))) normal = out;
    } else {
      const float radius = 0.5f * value.w;
      p = vec3(value) + radius * out;
      du = radius * around;
      dv = vec3(slope) + 0.5f * slope.w * out + radius * (cosine * f.sideSlope + sine * f.upSlope);
      normal = cross(around, dv);
      // it has no length, or is a cone without slope
      if (!(glm::length(normal) > 1e-4f * glm::length(dv))) normal = out;
    }
    if (normal == vec3(0)) normal = vec3(0, 0, 1);
  }

  /// Finds directions across the curve that turn no more than it does, by double reflection (W. Wang, B. Juettler, D.
  /// Zheng, Y. Liu 2008), segment by segment. On a closed curve the remaining twist is distributed evenly, so that its
  /// ends meet.
  void findSides() {
    sides_.resize(segments_.count());
    for (uint32_t k = 0; k < segments_.count() && !segments_.cubic(); ++k)
      joints_.push_back(
          {jointOf(segments_.chord(k), segments_.mitres(k)[0]), jointOf(segments_.chord(k), segments_.mitres(k)[1])});
    for (uint32_t first = 0; first < segments_.count(); first += segments_[first].of) carry(first, segments_[first].of);
  }

  void carry(uint32_t first, uint32_t count) {
    const uint32_t nodes = count * kSides;
    const auto placeOf = [&, nodes](uint32_t node, vec3& p, vec3& along) {
      if (node == nodes && !segments_[first].first) node = 0;  // closed
      const uint32_t segment = std::min(node / kSides, count - 1);
      const float v = static_cast<float>(node - segment * kSides) / kSides;
      vec3 slope;
      p = vec3(valueAt(segments_.line(first + segment), v));
      segments_.direction(first + segment, v, along, slope);
      along = segments_.cubic() ? normalizeOr(along, vec3(0)) : segments_.chord(first + segment);
    };
    vec3 p, along;
    placeOf(0, p, along);
    if (along == vec3(0)) along = vec3(0, 0, 1);
    const vec3 firstAlong = along, firstSide = acrossOf(along);
    vec3 side = firstSide;
    std::vector<vec3> sides = {side}, alongs = {along};
    for (uint32_t node = 1; node <= nodes; ++node) {
      vec3 nextP, next;
      placeOf(node, nextP, next);
      if (next == vec3(0)) next = along;
      const vec3 step = nextP - p;
      if (const float d = dot(step, step); d > 0) {
        const vec3 reflected = side - 2 / d * dot(step, side) * step, turned = along - 2 / d * dot(step, along) * step;
        const vec3 back = next - turned;
        const float e = dot(back, back);
        side = e > 0 ? reflected - 2 / e * dot(back, reflected) * back : reflected;
      }
      side = normalizeOr(side - next * dot(next, side), acrossOf(next));
      p = nextP;
      along = next;
      sides.push_back(side);
      alongs.push_back(along);
    }
    float excess = 0;
    if (!segments_[first].first) excess = std::atan2(dot(cross(firstSide, side), firstAlong), dot(firstSide, side));
    for (uint32_t k = 0; k < count; ++k)
      for (uint32_t i = 0; i <= kSides; ++i) {
        const float angle = -excess * static_cast<float>(k * kSides + i) / static_cast<float>(nodes);
        const uint32_t node = k * kSides + (segments_.cubic() ? i : 0);
        sides_[first + k][i] = std::cos(angle) * sides[node] + std::sin(angle) * cross(alongs[node], sides[node]);
      }
  }

  size_t shapeBytes() const override { return segments_.bytes() + bytesOf(ends_) + bytesOf(sides_) + bytesOf(joints_); }
  CurveSegments segments_;
  std::vector<End> ends_;
  std::vector<std::array<vec3, kSides + 1>> sides_;
  std::vector<std::array<Joint, 2>> joints_;  // of polylines
};

}  // namespace

PrimPtr makeTubes(bool cubic, const Basis& basis, const std::vector<int>& vertexCounts, bool periodic,
                  const ParamList& params, Problems& problems) {
  return std::make_shared<Tubes>(CurveSegments(cubic, basis, vertexCounts, periodic, params, problems));
}

}  // namespace tomales

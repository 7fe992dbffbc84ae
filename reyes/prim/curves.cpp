// Curves as ribbons (RISpec 3.2, Curves): u across and v along.
#include <utility>

#include "reyes/base/simd.h"
#include "reyes/prim/curve_segments.h"
#include "reyes/prim/facing.h"
#include "reyes/prim/interpolation.h"

namespace tomales {
namespace {

struct Vectors {
  float *x, *y, *z;
  vec3 get(int i) const { return {x[i], y[i], z[i]}; }
  void set(int i, const vec3& v) const {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

/// Cross sections of a ribbon: the unit vector `side`, and `up`, to which it faces; slopes are derivatives by v. Each
/// thread keeps the memory.
class Sections {
 public:
  explicit Sections(int count) : stride_(static_cast<size_t>(padded(count))) {
    static thread_local AlignedVector<float> memory;
    if (memory.size() < kArrays * stride_) memory.resize(kArrays * stride_);
    next_ = memory.data();
    v = array();
    width = array();
    widthSlope = array();
    for (Vectors* vectors : {&center, &slope, &along, &alongSlope, &up, &upSlope, &side, &sideSlope})
      *vectors = {array(), array(), array()};
  }
  float *v, *width, *widthSlope;
  Vectors center, slope, along, alongSlope, up, upSlope, side, sideSlope;

 private:
  static constexpr size_t kArrays = 27;
  float* array() { return std::exchange(next_, next_ + stride_); }
  const size_t stride_;
  float* next_;
};

/// Computes valueAt, slopeAt and curvatureAt of one component.
TOMALES_HOT void cubicAt(const float* c, int n, const float* v, float* __restrict value, float* __restrict slope,
                         float* __restrict curvature) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const float t = v[i], r = 1 - t;
    value[i] = r * r * r * c[0] + 3 * r * r * t * c[1] + 3 * r * t * t * c[2] + t * t * t * c[3];
    slope[i] = 3.0f * (r * r * (c[1] - c[0]) + 2 * r * t * (c[2] - c[1]) + t * t * (c[3] - c[2]));
    curvature[i] = 6.0f * (r * (c[2] - 2.0f * c[1] + c[0]) + t * (c[3] - 2.0f * c[2] + c[1]));
  }
}

template <class V>
void cubicAt(const Cubic<V>& line, int component, int n, const float* v, float* value, float* slope, float* curvature) {
  const float c[4] = {line[0][component], line[1][component], line[2][component], line[3][component]};
  cubicAt(c, n, v, value, slope, curvature);
}

/// Sets sides from along and up. A ribbon that is seen along its own direction gets a side of length 0.
TOMALES_HOT void turnSides(int n, const Sections& c) {
  const Vectors a = c.along, as = c.alongSlope, u = c.up, us = c.upSlope, side = c.side, ss = c.sideSlope;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const float ax = a.x[i], ay = a.y[i], az = a.z[i], ux = u.x[i], uy = u.y[i], uz = u.z[i];
    const float x = ay * uz - uy * az, y = az * ux - uz * ax, z = ax * uy - ux * ay;
    const float sx = (as.y[i] * uz - uy * as.z[i]) + (ay * us.z[i] - us.y[i] * az);
    const float sy = (as.z[i] * ux - uz * as.x[i]) + (az * us.x[i] - us.z[i] * ax);
    const float sz = (as.x[i] * uy - ux * as.y[i]) + (ax * us.y[i] - us.x[i] * ay);
    const float length2 = x * x + y * y + z * z, length = std::sqrt(length2);
    const bool turns = length2 > 1e-12f * (ax * ax + ay * ay + az * az) * (ux * ux + uy * uy + uz * uz);
    const float nx = x / length, ny = y / length, nz = z / length, slip = nx * sx + ny * sy + nz * sz;
    side.x[i] = turns ? nx : 0.0f;
    side.y[i] = turns ? ny : 0.0f;
    side.z[i] = turns ? nz : 0.0f;
    ss.x[i] = turns ? (sx - nx * slip) / length : 0.0f;
    ss.y[i] = turns ? (sy - ny * slip) / length : 0.0f;
    ss.z[i] = turns ? (sz - nz * slip) / length : 0.0f;
  }
}

/// Computes points of a ribbon; section[i] is the cross section of point i.
TOMALES_HOT void spread(int n, const float* u, const int* section, const Sections& c, const SurfacePoints& out) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const int k = section[i];
    const float at = u[i] - 0.5f, width = c.width[k], widthSlope = c.widthSlope[k], across = at * width;
    const float sx = c.side.x[k], sy = c.side.y[k], sz = c.side.z[k];
    const float dux = width * sx, duy = width * sy, duz = width * sz;
    const float dvx = c.slope.x[k] + at * (widthSlope * sx + width * c.sideSlope.x[k]);
    const float dvy = c.slope.y[k] + at * (widthSlope * sy + width * c.sideSlope.y[k]);
    const float dvz = c.slope.z[k] + at * (widthSlope * sz + width * c.sideSlope.z[k]);
    const float nx = duy * dvz - dvy * duz, ny = duz * dvx - dvz * dux, nz = dux * dvy - dvx * duy;
    const bool turns = nx * nx + ny * ny + nz * nz >
                       1e-12f * (dux * dux + duy * duy + duz * duz) * (dvx * dvx + dvy * dvy + dvz * dvz);
    // A ribbon without width or length still needs a normal.
    const float ux = c.up.x[k], uy = c.up.y[k], uz = c.up.z[k], lean = sx * ux + sy * uy + sz * uz;
    const float fx = ux - sx * lean, fy = uy - sy * lean, fz = uz - sz * lean, facing2 = fx * fx + fy * fy + fz * fz;
    const bool faces = facing2 > 0.0f && facing2 < kInfinity;
    const float facing = std::sqrt(faces ? facing2 : 1.0f);
    out.px[i] = c.center.x[k] + across * sx;
    out.py[i] = c.center.y[k] + across * sy;
    out.pz[i] = c.center.z[k] + across * sz;
    out.dux[i] = dux;
    out.duy[i] = duy;
    out.duz[i] = duz;
    out.dvx[i] = dvx;
    out.dvy[i] = dvy;
    out.dvz[i] = dvz;
    out.nx[i] = turns ? nx : faces ? fx / facing : 0.0f;
    out.ny[i] = turns ? ny : faces ? fy / facing : 0.0f;
    out.nz[i] = turns ? nz : faces ? fz / facing : 1.0f;
  }
}

class Ribbons : public Prim {
 public:
  explicit Ribbons(CurveSegments segments) : Prim(std::move(segments.primvars)), segments_(std::move(segments)) {
    if (const Primvar* normals = normalsOf(primvars_)) normals_ = segments_.along(*normals);
  }

  std::shared_ptr<const Prim> facing(const vec3& eye, const vec3& forward, bool perspective) const override {
    if (!normals_.empty()) return nullptr;
    auto turned = std::make_shared<Ribbons>(*this);
    turned->eye_ = {eye, forward, perspective};
    return turned;
  }

  bool isLone() const override { return true; }
  uint32_t patchCount() const override { return segments_.count(); }
  PatchInfo info(uint32_t patch) const override {
    const CurveSegment& s = segments_[patch];
    return {false, static_cast<uint8_t>(kEdgeU0 | kEdgeU1 | (s.first ? kEdgeV0 : 0) | (s.last ? kEdgeV1 : 0))};
  }

  Bound3 bound(uint32_t patch, const UvRect& r) const override {
    Bound3 line;
    float width = 0;
    for (const vec4& c : piece(segments_.line(patch), r.v0, r.v1)) {
      line.extend(vec3(c));
      width = std::max(width, c.w);
    }
    const float longer =
        segments_.cubic() ? 1 : std::max(mitreAt(patch, false).length(), mitreAt(patch, true).length());
    const Bound3 ribbon = line.grown(longer * width * std::max(std::abs(r.u0 - 0.5f), std::abs(r.u1 - 0.5f)));
    return paddedForRounding(ribbon, ribbon);
  }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    // Lattices run across the ribbon: successive points share a section.
    static thread_local std::vector<int> section;
    section.resize(static_cast<size_t>(n));
    Sections sections(n);
    int count = 0;
    for (int i = 0; i < n; ++i) {
      if (i == 0 || v[i] != v[i - 1]) sections.v[count++] = v[i];
      section[static_cast<size_t>(i)] = count - 1;
    }
    setSections(patch, count, sections);
    spread(n, u, section.data(), sections, out);
  }

  /// RISpec has v run along the whole curve.
  void surfaceParameters(uint32_t patch, int n, const float* u, const float* v, float* su, float* sv) const override {
    const CurveSegment& s = segments_[patch];
    std::copy_n(u, n, su);
    for (int i = 0; i < n; ++i) sv[i] = (static_cast<float>(s.number) + v[i]) / static_cast<float>(s.of);
  }

  void interpolate(uint32_t patch, int index, int n, const float*, const float* v, float* out,
                   int stride) const override {
    segments_.interpolate(primvars_[static_cast<size_t>(index)], patch, n, v, out, stride);
  }

 private:
  /// Computes the sections at their v.
  void setSections(uint32_t patch, int n, const Sections& c) const {
    const Cubic<vec4>& line = segments_.line(patch);
    cubicAt(line, 0, n, c.v, c.center.x, c.slope.x, c.alongSlope.x);
    cubicAt(line, 1, n, c.v, c.center.y, c.slope.y, c.alongSlope.y);
    cubicAt(line, 2, n, c.v, c.center.z, c.slope.z, c.alongSlope.z);
    cubicAt(line, 3, n, c.v, c.width, c.widthSlope, c.along.x);
    for (int i = 0; i < n; ++i) {
      const vec3 slope = c.slope.get(i);
      c.along.set(i, slope);
      if (slope != vec3(0)) continue;
      vec3 along, alongSlope;
      segments_.direction(patch, c.v[i], along, alongSlope);
      c.along.set(i, along);
      c.alongSlope.set(i, alongSlope);
    }
    setUp(patch, n, c);
    turnSides(n, c);
    if (!segments_.cubic()) mitre(patch, n, c);
    for (int i = 0; i < n; ++i) {
      if (c.side.x[i] != 0 || c.side.y[i] != 0 || c.side.z[i] != 0) continue;
      vec3 side, other;
      orthonormalBasis(normalizeOr(c.up.get(i), vec3(0, 0, 1)), side, other);
      c.side.set(i, side);
    }
  }

  /// The mitre where two segments of a polyline meet, as components across the segment and along it. It lies on the
  /// bisector of their sides, and is as long as both segments need to keep their width, up to 3.
  struct Mitre {
    float across = 1, along = 0;
    float length() const { return std::hypot(across, along); }
  };
  Mitre mitreAt(uint32_t patch, bool last) const {
    constexpr float kLongest = 3;
    const CurveSegment& s = segments_[patch];
    if (last ? s.last : s.first) return {};
    const size_t end = last ? 3 : 0;
    const vec3 up = normals_.empty() ? eye_.towards(vec3(segments_.line(patch)[end])) : normals_[patch][end];
    const vec3 side = normalizeOr(cross(segments_.chord(patch), up), vec3(0));
    const vec3 other = normalizeOr(cross(segments_.chord(segments_.neighbour(patch, last)), up), vec3(0));
    const vec3 bisector = normalizeOr(side + other, vec3(0));
    const float cosine = dot(bisector, side);
    if (side == vec3(0) || other == vec3(0) || !(cosine > 1e-4f)) return {};
    const float longer = std::min(1 / cosine, kLongest);
    return {longer * cosine, longer * dot(bisector, normalizeOr(cross(up, side), vec3(0)))};
  }

  /// Turns sides, which lie across the segment, towards the mitres at its ends; the borders stay straight.
  void mitre(uint32_t patch, int n, const Sections& c) const {
    const Mitre from = mitreAt(patch, false), to = mitreAt(patch, true);
    const float acrossSlope = to.across - from.across, alongSlope = to.along - from.along;
    for (int i = 0; i < n; ++i) {
      const vec3 side = c.side.get(i), sideSlope = c.sideSlope.get(i), up = c.up.get(i);
      const vec3 ahead = cross(up, side), aheadSlope = cross(c.upSlope.get(i), side) + cross(up, sideSlope);
      const float length = glm::length(ahead);
      if (!(length > 0)) continue;
      const vec3 unit = ahead / length, unitSlope = (aheadSlope - unit * dot(unit, aheadSlope)) / length;
      const float across = from.across + acrossSlope * c.v[i], along = from.along + alongSlope * c.v[i];
      c.side.set(i, across * side + along * unit);
      c.sideSlope.set(i, acrossSlope * side + across * sideSlope + alongSlope * unit + along * unitSlope);
    }
  }

  /// Sets the direction to which the ribbon faces.
  void setUp(uint32_t patch, int n, const Sections& c) const {
    const bool oriented = !normals_.empty();
    if (oriented) {
      float* const unused = c.side.x;
      cubicAt(normals_[patch], 0, n, c.v, c.up.x, c.upSlope.x, unused);
      cubicAt(normals_[patch], 1, n, c.v, c.up.y, c.upSlope.y, unused);
      cubicAt(normals_[patch], 2, n, c.v, c.up.z, c.upSlope.z, unused);
    }
    for (int i = 0; !oriented && i < n; ++i) {
      c.up.set(i, eye_.towards(c.center.get(i)));
      c.upSlope.set(i, eye_.perspective ? -c.slope.get(i) : vec3(0));
    }
  }

  size_t shapeBytes() const override { return segments_.bytes() + bytesOf(normals_); }
  CurveSegments segments_;
  std::vector<Cubic<vec3>> normals_;  // if empty, it faces the eye
  Eye eye_;
};

}  // namespace

PrimPtr makeCurves(bool cubic, const Basis& basis, const std::vector<int>& vertexCounts, bool periodic,
                   const ParamList& params, Problems& problems) {
  return std::make_shared<Ribbons>(CurveSegments(cubic, basis, vertexCounts, periodic, params, problems));
}

}  // namespace tomales

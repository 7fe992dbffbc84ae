#include "raytrace/emitter_shapes.h"

#include <array>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kFullTurn = 2 * 3.14159265358979323846;
// Below this solid angle (that of a lamp of 1 m at 30 km) the formula gives rounding errors only, and all points of a
// shape are equally far.
constexpr double kLeastSolidAngle = 1e-9;
constexpr double kTouch = 1e-4;        ///< A direction does not meet the shape from so near, in radii.
constexpr double kLeastCosine = 1e-5;  ///< Rounding leaves points of the emitter's own plane slightly in front of it.

/// A rectangle as seen from a point; names as in the paper.
class SphericalRectangle {
 public:
  SphericalRectangle(const EmitterShape& shape, const vec3& from) {
    const dvec3 d = dvec3(shape.center) - dvec3(from);
    x_ = glm::normalize(dvec3(shape.u));
    y_ = glm::normalize(dvec3(shape.v));
    z_ = cross(x_, y_);
    const double hx = glm::length(dvec3(shape.u)), hy = glm::length(dvec3(shape.v));
    z0_ = dot(d, z_);
    if (z0_ > 0) {
      z_ = -z_;
      z0_ = -z0_;
    }
    x0_ = dot(d, x_) - hx;
    y0_ = dot(d, y_) - hy;
    x1_ = x0_ + 2 * hx;
    y1_ = y0_ + 2 * hy;
    const std::array<dvec3, 4> corners = {dvec3(x0_, y0_, z0_), dvec3(x1_, y0_, z0_), dvec3(x1_, y1_, z0_),
                                          dvec3(x0_, y1_, z0_)};
    std::array<dvec3, 4> n;  // normals of the planes through the eye and an edge
    for (size_t i = 0; i < 4; ++i) {
      n[i] = cross(corners[i], corners[(i + 1) % 4]);
      const double length = glm::length(n[i]);
      if (!(length > 0)) return;
      n[i] /= length;
    }
    const auto angle = [&](size_t a, size_t b) { return std::acos(std::clamp(-dot(n[a], n[b]), -1.0, 1.0)); };
    b0_ = n[0].z;
    b1_ = n[2].z;
    k_ = kFullTurn - angle(2, 3) - angle(3, 0);
    solidAngle_ = angle(0, 1) + angle(1, 2) - k_;
  }

  double solidAngle() const { return solidAngle_; }

  /// Vector from the eye to a point of the rectangle.
  dvec3 sample(const dvec2& xi) const {
    const double au = xi.x * solidAngle_ + k_, fu = (std::cos(au) * b0_ - b1_) / std::sin(au);
    const double cu = std::clamp(std::copysign(1 / std::sqrt(fu * fu + b0_ * b0_), fu), -1.0, 1.0);
    const double xu = std::clamp(-(cu * z0_) / std::sqrt(std::max(1 - cu * cu, 1e-300)), x0_, x1_);
    const double d2 = xu * xu + z0_ * z0_;
    const double h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
    const double hv = h0 + xi.y * (h1 - h0), hv2 = hv * hv;
    const double yv = hv2 < 1 - 1e-12 ? hv * std::sqrt(d2 / (1 - hv2)) : y1_;
    return xu * x_ + std::clamp(yv, y0_, y1_) * y_ + z0_ * z_;
  }

 private:
  dvec3 x_, y_, z_;
  double x0_ = 0, x1_ = 0, y0_ = 0, y1_ = 0, z0_ = 0, b0_ = 0, b1_ = 0, k_ = 0, solidAngle_ = 0;
};

/// The cone x^2 / a^2 + y^2 / b^2 < z^2 that a disk fills. Its four quadrants mirror each other. The density over the
/// azimuth is linear in each of a number of steps, so that it is known exactly however eccentric the ellipse.
class EllipticalCone {
 public:
  EllipticalCone(const EmitterShape& disk, const vec3& from) {
    const dvec3 n = disk.normal, d = dvec3(disk.center) - dvec3(from);
    const double height = -dot(d, n), r = glm::length(dvec3(disk.u));
    if (!(height > 0)) return;
    const dvec3 across = d + height * n;  // vector from below the eye to the centre, in the plane
    const double off = glm::length(across);
    const dvec3 y = off > 1e-12 * (height + r) ? across / off : glm::normalize(dvec3(disk.u));
    // The nearest and the farthest point of the rim, and the ray that halves the angle between them.
    const double nearAngle = std::atan2(off - r, height), farAngle = std::atan2(off + r, height);
    const double middle = 0.5 * (nearAngle + farAngle);
    z_ = std::sin(middle) * y - std::cos(middle) * n;
    y_ = std::cos(middle) * y + std::sin(middle) * n;
    x_ = cross(y_, z_);
    const double at = height * std::tan(middle) - off;  // place where the chord meets the plane, from the centre
    const double halfChord = std::sqrt(std::max(0.0, r * r - at * at));
    a_ = halfChord * std::cos(middle) / height;
    b_ = std::tan(0.5 * (farAngle - nearAngle));
    if (!(a_ > 0 && b_ > 0)) return;
    for (size_t i = 0; i <= kSteps; ++i) width_[i] = versineAt(static_cast<double>(i) * kStep);
    for (size_t i = 0; i < kSteps; ++i) total_ += weight(i);
  }

  bool empty() const { return !(total_ > 0); }

  dvec3 sample(const dvec2& xi, double& pdf) const {
    double x = 4 * xi.x;
    const int quadrant = std::min(static_cast<int>(x), 3);
    x = (x - quadrant) * total_;
    size_t step = 0;
    while (step < kSteps - 1 && x >= weight(step)) x -= weight(step++);
    const double part = std::min(x / weight(step), 1.0), a = width_[step], b = width_[step + 1];
    const double within = part * (a + b) / (a + std::sqrt(a * a + part * (b * b - a * a)));
    const double phi = (static_cast<double>(step) + within) * kStep;
    const double versine = xi.y * versineAt(phi), sine = std::sqrt(versine * (2 - versine));
    pdf = pdfAt(phi);
    return (quadrant & 1 ? -sine : sine) * std::cos(phi) * x_ + (quadrant & 2 ? -sine : sine) * std::sin(phi) * y_ +
           (1 - versine) * z_;
  }

  /// Pre: the direction is inside.
  double pdf(const dvec3& direction) const {
    return pdfAt(std::atan2(std::abs(dot(direction, y_)), std::abs(dot(direction, x_))));
  }

 private:
  static constexpr size_t kSteps = 16;  ///< Steps of a quadrant.
  static constexpr double kStep = kFullTurn / 4 / static_cast<double>(kSteps);

  /// One less the cosine of the angle from the axis to the rim.
  double versineAt(double phi) const {
    const double k = std::pow(std::cos(phi) / a_, 2) + std::pow(std::sin(phi) / b_, 2);
    return 1 / ((1 + k) * (1 + std::sqrt(k / (1 + k))));
  }
  double weight(size_t step) const { return 0.5 * (width_[step] + width_[step + 1]); }
  /// phi is in 0 to a quarter turn.
  double pdfAt(double phi) const {
    const double x = phi / kStep;
    const size_t step = std::min(static_cast<size_t>(x), kSteps - 1);
    const double width = glm::mix(width_[step], width_[step + 1], x - static_cast<double>(step));
    return width / (4 * total_ * kStep * versineAt(phi));
  }

  dvec3 x_, y_, z_;
  double a_ = 0, b_ = 0, total_ = 0;
  std::array<double, kSteps + 1> width_{};  ///< versineAt() between the steps.
};

/// One less the cosine of the angle from the centre of a sphere to its rim; 0 for a point inside.
double coneOf(const EmitterShape& sphere, const dvec3& toCenter) {
  const double sine2 = dot(dvec3(sphere.u), dvec3(sphere.u)) / dot(toCenter, toCenter);
  return sine2 < 1 ? sine2 / (1 + std::sqrt(1 - sine2)) : 0;
}

SeenPoint sampleSphere(const EmitterShape& sphere, const vec3& from, const vec2& xi) {
  const dvec3 d = dvec3(sphere.center) - dvec3(from);
  const double cone = coneOf(sphere, d);
  if (!(cone > 0)) return {};
  const double distance = glm::length(d), r = glm::length(dvec3(sphere.u));
  const double versine = xi.x * cone, sine2 = versine * (2 - versine), phi = kFullTurn * static_cast<double>(xi.y);
  // Along the ray, from the point nearest to the centre to the point where it enters.
  const double miss2 = distance * distance * sine2,
               t = (1 - versine) * distance - std::sqrt(std::max(0.0, r * r - miss2));
  vec3 tangent, bitangent;
  const dvec3 axis = d / distance;
  orthonormalBasis(vec3(axis), tangent, bitangent);
  const dvec3 direction =
      std::sqrt(sine2) * (std::cos(phi) * dvec3(tangent) + std::sin(phi) * dvec3(bitangent)) + (1 - versine) * axis;
  const dvec3 N = glm::normalize(t * direction - d);
  return {vec3(dvec3(sphere.center) + r * N), vec3(N), static_cast<float>(1 / (kFullTurn * cone))};
}

SeenPoint meetSphere(const EmitterShape& sphere, const vec3& from, const dvec3& direction) {
  const dvec3 d = dvec3(sphere.center) - dvec3(from);
  const double cone = coneOf(sphere, d), along = dot(d, direction), r = glm::length(dvec3(sphere.u));
  const dvec3 miss = d - along * direction;
  const double inside = r * r - dot(miss, miss);
  if (!(cone > 0) || along <= 0 || inside <= 0) return {};
  const dvec3 N = glm::normalize((along - std::sqrt(inside)) * direction - d);
  return {vec3(dvec3(sphere.center) + r * N), vec3(N), static_cast<float>(1 / (kFullTurn * cone))};
}

/// The point where a direction meets a flat shape's plane, relative to the shape's centre and in units of u and v.
struct PlanePoint {
  dvec3 P{0};
  double u = 0, v = 0;
  bool seen = false;
};
/// Points of the emitter itself lie on either side of its plane, by rounding. They count as behind it: otherwise the
/// emitter could fill half of the sky of points on its own back.
bool behind(const EmitterShape& flat, const vec3& from) {
  constexpr double kRounding = 5e-6;
  const dvec3 center = flat.center;
  const double reach =
      glm::length(dvec3(from)) + glm::length(center) + glm::length(dvec3(flat.u)) + glm::length(dvec3(flat.v));
  return !(dot(dvec3(from) - center, dvec3(flat.normal)) > kRounding * reach);
}

PlanePoint planePoint(const EmitterShape& flat, const vec3& from, const dvec3& direction) {
  const dvec3 d = dvec3(flat.center) - dvec3(from), n = flat.normal, u = flat.u, v = flat.v;
  const double facing = -dot(direction, n);
  if (!(facing > kLeastCosine) || behind(flat, from)) return {};
  const dvec3 P = direction * (-dot(d, n) / facing) - d;
  return {P, dot(P, u) / dot(u, u), dot(P, v) / dot(v, v), true};
}

SeenPoint onFlat(const EmitterShape& flat, const dvec3& fromCenter, double pdf) {
  return {vec3(dvec3(flat.center) + fromCenter), flat.normal, static_cast<float>(pdf)};
}

/// Rounding must neither lose the whole shape nor brighten it by a wrong solid angle: far or edge-on shapes are sampled
/// by area.
bool isSmall(double solidAngle) { return !(solidAngle > kLeastSolidAngle); }

SeenPoint byArea(const EmitterShape& flat, const vec3& from, const vec2& xi) {
  SeenPoint out = sampleArea(flat, xi);
  out.pdf = static_cast<float>(solidAnglePdf(from, out.P, out.N, double{out.pdf}));
  return out;
}

}  // namespace

double solidAnglePdf(const vec3& from, const vec3& P, const vec3& N, double areaPdf) {
  const dvec3 path = dvec3(P) - dvec3(from);
  const double d2 = dot(path, path), cosine = -dot(dvec3(N), path) / std::sqrt(d2);
  return d2 > 0 && cosine > kLeastCosine ? areaPdf * d2 / cosine : 0;
}

vec3 directionOnSphere(const vec2& xi) {
  const float z = 1 - 2 * xi.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * xi.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

float EmitterShape::area() const {
  if (kind == Kind::Sphere) return 4 * kPi * dot(u, u);
  return (kind == Kind::Disk ? kPi : 4) * glm::length(u) * glm::length(v);
}

SeenPoint sampleArea(const EmitterShape& shape, const vec2& xi) {
  const float pdf = 1 / shape.area();
  if (shape.kind == EmitterShape::Kind::Sphere) {
    const vec3 N = directionOnSphere(xi);
    return {shape.center + glm::length(shape.u) * N, N, pdf};
  }
  const vec2 at = shape.kind == EmitterShape::Kind::Disk ? vec2(cosineHemisphere(xi)) : 2.0f * xi - 1.0f;
  return {shape.center + at.x * shape.u + at.y * shape.v, shape.normal, pdf};
}

SeenPoint sampleSolidAngle(const EmitterShape& shape, const vec3& from, const vec2& xi) {
  if (shape.kind == EmitterShape::Kind::Sphere) return sampleSphere(shape, from, xi);
  if (behind(shape, from)) return {};
  if (shape.kind == EmitterShape::Kind::Rectangle) {
    const SphericalRectangle seen(shape, from);
    if (isSmall(seen.solidAngle())) return byArea(shape, from, xi);
    const dvec3 path = seen.sample(dvec2(xi));
    return onFlat(shape, path - (dvec3(shape.center) - dvec3(from)), 1 / seen.solidAngle());
  }
  const EllipticalCone cone(shape, from);
  if (cone.empty()) return byArea(shape, from, xi);
  double pdf = 0;
  const dvec3 direction = cone.sample(dvec2(xi), pdf);
  const PlanePoint at = planePoint(shape, from, direction);
  return at.seen ? onFlat(shape, at.P, pdf) : SeenPoint{};
}

SeenPoint meet(const EmitterShape& shape, const vec3& from, const vec3& direction) {
  const dvec3 unit = glm::normalize(dvec3(direction));
  if (shape.kind == EmitterShape::Kind::Sphere) return meetSphere(shape, from, unit);
  const PlanePoint at = planePoint(shape, from, unit);
  if (!at.seen) return {};
  const auto areaPdf = [&] {
    return solidAnglePdf(from, vec3(dvec3(shape.center) + at.P), shape.normal, 1 / double{shape.area()});
  };
  if (shape.kind == EmitterShape::Kind::Rectangle) {
    if (std::abs(at.u) > 1 || std::abs(at.v) > 1) return {};
    const SphericalRectangle seen(shape, from);
    return onFlat(shape, at.P, isSmall(seen.solidAngle()) ? areaPdf() : 1 / seen.solidAngle());
  }
  if (at.u * at.u + at.v * at.v > 1) return {};
  const EllipticalCone cone(shape, from);
  return onFlat(shape, at.P, cone.empty() ? areaPdf() : cone.pdf(unit));
}

void crossings(const EmitterShape& shape, const vec3& from, const vec3& direction, std::vector<SeenPoint>& out) {
  const dvec3 center = shape.center, d = center - dvec3(from), unit = glm::normalize(dvec3(direction));
  const float pdf = 1 / shape.area();
  if (shape.kind == EmitterShape::Kind::Sphere) {
    const double r = glm::length(dvec3(shape.u)), along = dot(d, unit);
    const dvec3 miss = d - along * unit;
    const double half2 = r * r - dot(miss, miss);
    for (const double side : {-1.0, 1.0}) {
      const double t = along + side * std::sqrt(std::max(0.0, half2));
      if (half2 > 0 && t > kTouch * r) out.push_back({vec3(dvec3(from) + t * unit), vec3((t * unit - d) / r), pdf});
    }
    return;
  }
  const dvec3 u = shape.u, v = shape.v, n = shape.normal;
  const double cosine = dot(unit, n), t = dot(d, n) / cosine;
  if (!(std::abs(cosine) > kLeastCosine) || !(t > kTouch * glm::length(u))) return;
  const dvec3 P = t * unit - d;
  const double x = dot(P, u) / dot(u, u), y = dot(P, v) / dot(v, v);
  const bool meets = shape.kind == EmitterShape::Kind::Disk ? x * x + y * y <= 1 : std::abs(x) <= 1 && std::abs(y) <= 1;
  if (meets) out.push_back({vec3(center + P), shape.normal, pdf});
}

}  // namespace tomales

#include <array>

#include "reyes/prim/primvars.h"
#include "reyes/prim/revolution.h"

namespace tomales {
namespace {

constexpr double kTurn = 2 * M_PI;

void requireArea(bool area, const char* sentence) {
  if (!area) throw PrimError(sentence);
}

/// A meridian that is an arc around (center, 0): sphere and torus.
class ArcRevolution : public Revolution {
 public:
  ArcRevolution(float center, float radius, double phi0_turns, double phi1_turns, float thetaMax_degrees,
                const ParamList& params, Problems& problems)
      : Revolution(thetaMax_degrees, params, problems),
        center_(center),
        radius_(radius),
        start_turns_(static_cast<float>(phi0_turns)),
        range_turns_(static_cast<float>(phi1_turns - phi0_turns)) {
    if (std::abs(range_turns_) == 1) close(kEdgeV0 | kEdgeV1);
    if (isPole(phi0_turns)) close(kEdgeV0);
    if (isPole(phi1_turns)) close(kEdgeV1);
  }

  std::optional<RoundShape> round() const override {
    const bool poleToPole =
        isPole(start_turns_) && isPole(start_turns_ + range_turns_) && std::abs(range_turns_) == 0.5f;
    if (center_ != 0 || !poleToPole || !isClosed()) return std::nullopt;
    return RoundShape{vec3(0), std::abs(radius_), vec3(0)};
  }

 protected:
  void meridian(int n, const float* v, Meridian& m) const override {
    sinCosTurns(start_turns_, range_turns_, n, v, m.nz, m.nx);
    const float speed = radius_ * static_cast<float>(kTurn) * range_turns_;
    const float flip = std::copysign(1.0f, speed);
    for (int i = 0; i < n; ++i) {
      const float sine = m.nz[i], cosine = m.nx[i];
      m.x[i] = center_ + radius_ * cosine;
      m.y[i] = 0;
      m.z[i] = radius_ * sine;
      m.dx[i] = -speed * sine;
      m.dy[i] = 0;
      m.dz[i] = speed * cosine;
      // Where the arc crosses the axis (a spindle torus), dPdu reverses, and so does dPdu x dPdv.
      const float side = m.x[i] == 0 ? (radius_ < 0 ? -flip : flip) : m.x[i] < 0 ? -flip : flip;
      m.nx[i] = side * cosine;
      m.ny[i] = 0;
      m.nz[i] = side * sine;
    }
  }

  std::array<vec3, 2> meridianHull(float v0, float v1) const override {
    const double a = start_turns_ + static_cast<double>(range_turns_) * v0,
                 b = start_turns_ + static_cast<double>(range_turns_) * v1;
    const double lo = std::min(a, b), hi = std::max(a, b);
    Bound3 box;
    const auto extendAt = [&](double turn) {
      box.extend(vec3(center_ + radius_ * std::cos(kTurn * turn), 0, radius_ * std::sin(kTurn * turn)));
    };
    extendAt(lo);
    extendAt(hi);
    for (double quarter = std::ceil(4 * lo); quarter <= 4 * hi; ++quarter) extendAt(quarter / 4);
    return {box.lo, box.hi};
  }

 private:
  bool isPole(double turns) const {
    return std::abs(center_ + radius_ * std::cos(kTurn * turns)) < 1e-6 * std::abs(radius_);
  }

  float center_, radius_, start_turns_, range_turns_;
};

/// A meridian that is a straight line from a to b: cone, cylinder, disk and hyperboloid.
class LineRevolution : public Revolution {
 public:
  LineRevolution(const vec3& a, const vec3& b, float thetaMax_degrees, const ParamList& params, Problems& problems)
      : Revolution(thetaMax_degrees, params, problems), a_(a), b_(b) {
    if (a.x == 0 && a.y == 0) close(kEdgeV0);
    if (b.x == 0 && b.y == 0) close(kEdgeV1);
  }

  std::optional<RoundShape> round() const override {
    const bool disk = a_.z == b_.z && b_.x == 0 && b_.y == 0;
    if (!disk || !isClosed()) return std::nullopt;
    return RoundShape{b_, glm::length(vec2(a_)), vec3(0, 0, 1)};
  }

 protected:
  void meridian(int n, const float* v, Meridian& m) const override {
    const vec3 d = b_ - a_;
    for (int i = 0; i < n; ++i) {
      const vec3 p = a_ * (1 - v[i]) + b_ * v[i];
      m.x[i] = p.x;
      m.y[i] = p.y;
      m.z[i] = p.z;
      m.dx[i] = d.x;
      m.dy[i] = d.y;
      m.dz[i] = d.z;
      const vec2 r = awayFromAxis(v[i]);
      m.nx[i] = r.x * d.z;
      m.ny[i] = r.y * d.z;
      m.nz[i] = -(r.x * d.x + r.y * d.y);
    }
  }

  std::array<vec3, 2> meridianHull(float v0, float v1) const override {
    return {a_ * (1 - v0) + b_ * v0, a_ * (1 - v1) + b_ * v1};
  }

 private:
  /// Returns the unit direction from the axis to the meridian; where they meet, its limit from inside the surface.
  vec2 awayFromAxis(float v) const {
    const vec2 a(a_.x, a_.y), b(b_.x, b_.y);
    vec2 r = a * (1 - v) + b * v;
    const float reach = 1e-4f * (glm::length(a) + glm::length(b));
    if (glm::length(r) <= reach) {
      const float inside = v < 0.5f ? v + 1e-3f : v - 1e-3f;
      r = a * (1 - inside) + b * inside;
    }
    return r / glm::length(r);
  }

  vec3 a_, b_;
};

/// The meridian is r = rmax sqrt(z / zmax).
class Paraboloid : public Revolution {
 public:
  Paraboloid(float rmax, float zmin, float zmax, float thetaMax_degrees, const ParamList& params, Problems& problems)
      : Revolution(thetaMax_degrees, params, problems), rmax_(rmax), zmin_(zmin), zmax_(zmax) {
    if (zmin == 0) close(kEdgeV0);
  }

 protected:
  void meridian(int n, const float* v, Meridian& m) const override {
    const float range = zmax_ - zmin_, slope = rmax_ * rmax_ / (2 * zmax_);  // r dr/dz
    const float flip = std::copysign(1.0f, range) * std::copysign(1.0f, rmax_);
    for (int i = 0; i < n; ++i) {
      const float z = zmin_ * (1 - v[i]) + zmax_ * v[i], root = std::sqrt(std::max(0.0f, z / zmax_));
      m.x[i] = rmax_ * root;
      m.y[i] = 0;
      m.z[i] = z;
      // dr/dz is infinite at the apex; below a thousandth of the radius it keeps its value there.
      m.dx[i] = range * slope / (rmax_ * std::max(root, 1e-3f));
      m.dy[i] = 0;
      m.dz[i] = range;
      m.nx[i] = flip * std::abs(rmax_) * root;
      m.ny[i] = 0;
      m.nz[i] = -flip * slope;
    }
  }

  std::array<vec3, 2> meridianHull(float v0, float v1) const override { return {at(v0), at(v1)}; }

 private:
  vec3 at(float v) const {
    const float z = zmin_ * (1 - v) + zmax_ * v;
    return {rmax_ * std::sqrt(std::max(0.0f, z / zmax_)), 0, z};
  }

  float rmax_, zmin_, zmax_;
};

/// Returns the latitude where a sphere is cut: RISpec clips zmin and zmax to the poles.
double latitude_turns(float z, float radius) {
  return std::asin(std::clamp(static_cast<double>(z) / radius, -1.0, 1.0)) / kTurn;
}

}  // namespace

PrimPtr makeSphere(float radius, float zmin, float zmax, float thetaMax_degrees, const ParamList& params,
                   Problems& problems) {
  requireFinite({radius, zmin, zmax}, "the sphere");
  requireArea(radius != 0, "the sphere's radius is 0");
  const double phi0 = latitude_turns(zmin, radius), phi1 = latitude_turns(zmax, radius);
  requireArea(phi0 != phi1, "the sphere's zmin and zmax leave nothing of it");
  return std::make_shared<ArcRevolution>(0.0f, radius, phi0, phi1, thetaMax_degrees, params, problems);
}

PrimPtr makeTorus(float major, float minor, float phiMin_degrees, float phiMax_degrees, float thetaMax_degrees,
                  const ParamList& params, Problems& problems) {
  requireFinite({major, minor, phiMin_degrees, phiMax_degrees}, "the torus");
  requireArea(minor != 0, "the torus's minor radius is 0");
  requireArea(phiMin_degrees != phiMax_degrees, "the torus's phimin and phimax are equal");
  const double range = std::clamp((static_cast<double>(phiMax_degrees) - phiMin_degrees) / 360, -1.0, 1.0);
  const double start = phiMin_degrees / 360.0;
  return std::make_shared<ArcRevolution>(major, minor, start, start + range, thetaMax_degrees, params, problems);
}

PrimPtr makeCone(float height, float radius, float thetaMax_degrees, const ParamList& params, Problems& problems) {
  requireFinite({height, radius}, "the cone");
  requireArea(radius != 0, "the cone's radius is 0");
  return std::make_shared<LineRevolution>(vec3(radius, 0, 0), vec3(0, 0, height), thetaMax_degrees, params, problems);
}

PrimPtr makeDisk(float height, float radius, float thetaMax_degrees, const ParamList& params, Problems& problems) {
  requireFinite({height, radius}, "the disk");
  requireArea(radius != 0, "the disk's radius is 0");
  return std::make_shared<LineRevolution>(vec3(radius, 0, height), vec3(0, 0, height), thetaMax_degrees, params,
                                          problems);
}

PrimPtr makeCylinder(float radius, float zmin, float zmax, float thetaMax_degrees, const ParamList& params,
                     Problems& problems) {
  requireFinite({radius, zmin, zmax}, "the cylinder");
  requireArea(radius != 0, "the cylinder's radius is 0");
  requireArea(zmin != zmax, "the cylinder's zmin and zmax are equal");
  return std::make_shared<LineRevolution>(vec3(radius, 0, zmin), vec3(radius, 0, zmax), thetaMax_degrees, params,
                                          problems);
}

PrimPtr makeHyperboloid(const vec3& point1, const vec3& point2, float thetaMax_degrees, const ParamList& params,
                        Problems& problems) {
  requireFinite({point1.x, point1.y, point1.z, point2.x, point2.y, point2.z}, "the hyperboloid");
  requireArea(point1 != point2, "the hyperboloid's two points are equal");
  requireArea(point1.x != 0 || point1.y != 0 || point2.x != 0 || point2.y != 0,
              "both of the hyperboloid's points are on its axis");
  return std::make_shared<LineRevolution>(point1, point2, thetaMax_degrees, params, problems);
}

PrimPtr makeParaboloid(float rmax, float zmin, float zmax, float thetaMax_degrees, const ParamList& params,
                       Problems& problems) {
  requireFinite({rmax, zmin, zmax}, "the paraboloid");
  requireArea(rmax != 0, "the paraboloid's radius is 0");
  requireArea(zmax != 0, "the paraboloid's zmax is 0");
  requireArea(zmin != zmax, "the paraboloid's zmin and zmax are equal");
  requireArea(zmin / zmax >= 0, "the paraboloid's zmin and zmax lie on different sides of its apex");
  return std::make_shared<Paraboloid>(rmax, zmin, zmax, thetaMax_degrees, params, problems);
}

namespace {

template <auto Make, int... I>
PrimPtr makeOf(const float* numbers, std::integer_sequence<int, I...>, const ParamList& params, Problems& problems) {
  return Make(numbers[I]..., params, problems);
}
template <int count, auto Make>
PrimPtr makeOf(const float* numbers, const ParamList& params, Problems& problems) {
  return makeOf<Make>(numbers, std::make_integer_sequence<int, count>(), params, problems);
}

PrimPtr hyperboloidOf(const float* n, const ParamList& params, Problems& problems) {
  return makeHyperboloid({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6], params, problems);
}

}  // namespace

bool Quadric::hasNoArea(const float* n) const {
  const bool empty = extentCount > 0 && std::equal(n + from, n + from + extentCount, n + to);
  return empty || std::any_of(sizes.begin(), sizes.end(), [&](int i) { return n[i] == 0; });
}

const std::vector<Quadric>& quadrics() {
  static const std::vector<Quadric> table = {
      {.name = "Sphere",
       .numberCount = 4,
       .make = makeOf<4, makeSphere>,
       .sizes = {0, 3},
       .from = 1,
       .to = 2,
       .extentCount = 1},
      {.name = "Cone", .numberCount = 3, .make = makeOf<3, makeCone>, .sizes = {1, 2}},
      {.name = "Cylinder",
       .numberCount = 4,
       .make = makeOf<4, makeCylinder>,
       .sizes = {0, 3},
       .from = 1,
       .to = 2,
       .extentCount = 1},
      {.name = "Hyperboloid",
       .numberCount = 7,
       .make = hyperboloidOf,
       .sizes = {6},
       .from = 0,
       .to = 3,
       .extentCount = 3},
      {.name = "Paraboloid",
       .numberCount = 4,
       .make = makeOf<4, makeParaboloid>,
       .sizes = {0, 3},
       .from = 1,
       .to = 2,
       .extentCount = 1},
      {.name = "Disk", .numberCount = 3, .make = makeOf<3, makeDisk>, .sizes = {1, 2}},
      {.name = "Torus",
       .numberCount = 5,
       .make = makeOf<5, makeTorus>,
       .sizes = {1, 4},
       .from = 2,
       .to = 3,
       .extentCount = 1},
  };
  return table;
}

const Quadric* findQuadric(std::string_view name) {
  for (const Quadric& q : quadrics())
    if (q.name == name) return &q;
  return nullptr;
}

}  // namespace tomales

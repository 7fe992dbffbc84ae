// Particles as disks, squares or spheres (RISpec 3.2, Points).
#include <fmt/format.h>

#include "reyes/prim/disk_lattice.h"
#include "reyes/prim/facing.h"
#include "reyes/prim/interpolation.h"
#include "reyes/prim/primvars.h"
#include "reyes/prim/revolution.h"
#include "reyes/prim/sampled_bound.h"
#include "reyes/scattered.h"

namespace tomales {
namespace {

/// Returns the area of the trapezoids that a lattice of nu meridians and nv zones makes of the unit sphere.
double latticeSphereArea(int nu, int nv) {
  double area = 0;
  for (int k = 0; k < nv; ++k) {
    const double low = M_PI * (static_cast<double>(k) / nv - 0.5), high = low + M_PI / nv;
    const double chord = std::sin(M_PI / nu), a = chord * std::cos(low), b = chord * std::cos(high);
    const double depth = std::cos(M_PI / nu) * (std::cos(low) - std::cos(high)), rise = std::sin(high) - std::sin(low);
    area += nu * (a + b) * std::hypot(depth, rise);
  }
  return area;
}

/// Particles of any shape: each has a place and a width.
class Particles : public Prim, public Scattered {
 public:
  Particles(std::vector<vec3> points, std::vector<Primvar> primvars)
      : Prim(std::move(primvars)), points_(std::move(points)), width_(widthOf(primvars_)) {}

  uint32_t patchCount() const override { return static_cast<uint32_t>(points_.size()); }
  void prefetch(uint32_t patch) const override { __builtin_prefetch(&points_[patch]); }

  void evaluateLattice(uint32_t patch, int nu, int nv, const float* u, const float* v,
                       SurfacePoints out) const override {
    evaluate(patch, (nu + 1) * (nv + 1), u, v, out);
    const auto more = static_cast<float>(std::clamp(inflation(nu, nv) - 1, 0.0, double{kMostInflation} - 1));
    const vec3 center = points_[patch];
    for (int i = 0; i < (nu + 1) * (nv + 1); ++i) {
      out.px[i] += more * (out.px[i] - center.x);
      out.py[i] += more * (out.py[i] - center.y);
      out.pz[i] += more * (out.pz[i] - center.z);
    }
  }

  void interpolate(uint32_t patch, int index, int n, const float*, const float*, float* out,
                   int stride) const override {
    const Primvar& var = primvars_[static_cast<size_t>(index)];
    if (!repeatIfEven(var, 0, n, out, stride))
      repeatElement(&var.values[patch * static_cast<size_t>(var.width)], var.width, n, out, stride);
  }

 protected:
  static constexpr float kMostInflation = 1.5f;

  /// Returns the factor on the radius with which the lattice's polygons have the shape's area.
  virtual double inflation(int nu, int nv) const = 0;

  /// Grows the bound of a whole patch to contain every lattice over it.
  Bound3 boundInflated(uint32_t patch, const UvRect& r, Bound3 bound) const {
    const vec3 center = points_[patch];
    if (r.u0 <= 0 && r.u1 >= 1 && r.v0 <= 0 && r.v1 >= 1)
      bound = {center + kMostInflation * (bound.lo - center), center + kMostInflation * (bound.hi - center)};
    return paddedForRounding(bound, bound);
  }

  float radiusOf(uint32_t patch) const { return 0.5f * width_.values[width_.values.size() > 1 ? patch : 0]; }

  size_t shapeBytes() const override { return bytesOf(points_) + bytesOf(width_.values); }

  std::vector<vec3> points_;
  Primvar width_;
};

/// Flat shapes, whose plane has the normal "N" or faces the eye.
template <class Shape>
class FlatPoints : public Particles {
 public:
  bool isLone() const override { return true; }
  using Particles::Particles;

  std::shared_ptr<const Prim> facing(const vec3& eye, const vec3& forward, bool perspective) const override {
    if (normalsOf(primvars_)) return nullptr;
    auto turned = std::make_shared<Shape>(static_cast<const Shape&>(*this));
    turned->eye_ = {eye, forward, perspective};
    return turned;
  }

 protected:
  vec3 normalOf(uint32_t patch) const {
    const Primvar* given = normalsOf(primvars_);
    const float* n = given ? &given->values[given->values.size() > 3 ? 3 * static_cast<size_t>(patch) : 0] : nullptr;
    return normalizeOr(n ? vec3(n[0], n[1], n[2]) : eye_.towards(points_[patch]), vec3(0, 0, 1));
  }

  Eye eye_;
};

class Disks : public FlatPoints<Disks> {
 public:
  using FlatPoints::FlatPoints;

  PatchInfo info(uint32_t) const override { return {false, kAllEdges, true}; }

  Bound3 bound(uint32_t patch, const UvRect& r) const override {
    if (r.u0 <= 0 && r.u1 >= 1 && r.v0 <= 0 && r.v1 >= 1) {
      const vec3 center = points_[patch], normal = normalOf(patch);
      const vec3 n2 = normal * normal;  // 1 - n2 would cancel near an axis.
      const vec3 reach = radiusOf(patch) * glm::sqrt(vec3(n2.y + n2.z, n2.z + n2.x, n2.x + n2.y));
      return boundInflated(patch, r, {center - reach, center + reach});
    }
    const Disk disk = diskOf(patch);
    const auto range = [](float t0, float t1, float s0, float s1) {  // range of t * sqrt(1 - s * s / 2)
      t0 = 2 * t0 - 1;
      t1 = 2 * t1 - 1;
      s0 = 2 * s0 - 1;
      s1 = 2 * s1 - 1;
      const auto factor = [](float s) { return std::sqrt(1 - 0.5f * s * s); };
      const float least = std::min(factor(s0), factor(s1)),
                  most = s0 < 0 && s1 > 0 ? 1 : std::max(factor(s0), factor(s1));
      return vec2(t0 * (t0 < 0 ? most : least), t1 * (t1 > 0 ? most : least));
    };
    const vec2 x = range(r.u0, r.u1, r.v0, r.v1), y = range(r.v0, r.v1, r.u0, r.u1);
    Bound3 bound;
    for (int k = 0; k < 4; ++k)
      bound.extend(disk.center + disk.radius * (x[k & 1] * disk.tangent + y[k >> 1] * disk.bitangent));
    return boundInflated(patch, r, bound);
  }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    evaluateDisk(diskOf(patch), n, u, v, out);
  }

  /// Most particles are one cell: its corners, to the bit, are computed without loops and tables.
  void evaluateLattice(uint32_t patch, int nu, int nv, const float* u, const float* v,
                       SurfacePoints out) const override {
    if (nu != 1 || nv != 1) return Particles::evaluateLattice(patch, nu, nv, u, v, out);
    static const float more = static_cast<float>(inflation(1, 1) - 1);
    evaluateDot(diskOf(patch), more, out);
  }

  double inflation(int nu, int nv) const override { return std::sqrt(M_PI / latticeDiskArea(nu, nv)); }

 private:
  Disk diskOf(uint32_t patch) const {
    Disk disk;
    disk.center = points_[patch];
    disk.radius = radiusOf(patch);
    disk.normal = normalOf(patch);
    orthonormalBasis(disk.normal, disk.tangent, disk.bitangent);
    return disk;
  }
};

/// PRMan's "patch": pictures on cards. v runs down, against the object's y as projected onto the card's plane. u runs
/// to the right for a viewer of the front in a left-handed space. "patchangle" turns the card, and "patchaspectratio"
/// is width over height.
class Squares : public FlatPoints<Squares> {
 public:
  Squares(std::vector<vec3> points, std::vector<Primvar> primvars)
      : FlatPoints(std::move(points), std::move(primvars)),
        angle_degrees_(numbersOf("patchangle", 0)),
        aspect_(numbersOf("patchaspectratio", 1)) {
    for (const float a : aspect_)
      if (!(a > 0)) throw PrimError(fmt::format("patchaspectratio is {} somewhere", a));
  }

  PatchInfo info(uint32_t) const override { return {true, kAllEdges}; }

  Bound3 bound(uint32_t patch, const UvRect& r) const override {
    const Card card = cardOf(patch);
    Bound3 bound;
    for (int k = 0; k < 4; ++k) bound.extend(card.at(k & 1 ? r.u1 : r.u0, k >> 1 ? r.v1 : r.v0));
    return paddedForRounding(bound, bound);
  }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    const Card card = cardOf(patch);
    for (int i = 0; i < n; ++i) {
      setFrame(out, i, card.at(u[i], v[i]), card.right, card.down);
      setNormal(out, i, cross(card.right, card.down));
    }
  }

 protected:
  double inflation(int, int) const override { return 1; }

 private:
  struct Card {
    vec3 center, right, down;
    vec3 at(float u, float v) const { return center + (u - 0.5f) * right + (v - 0.5f) * down; }
  };

  Card cardOf(uint32_t patch) const {
    const vec3 normal = normalOf(patch);
    vec3 right, down;
    orthonormalBasis(normal, right, down);
    right = normalizeOr(cross(normal, vec3(0, 1, 0)), right);
    down = cross(normal, right);
    const float turn = glm::radians(valueOf(angle_degrees_, patch)), width = 2 * radiusOf(patch);
    const float c = std::cos(turn), s = std::sin(turn);
    return {points_[patch], width * (c * right - s * down), width / valueOf(aspect_, patch) * (c * down + s * right)};
  }

  /// Returns the values of the primvar "constant" + name, or of `name`: one for all points, or one for each.
  std::vector<float> numbersOf(const std::string& name, float fallback) const {
    std::vector<float> out{fallback};
    for (const std::string& wanted : {"constant" + name, name})
      for (const Primvar& var : primvars_)
        if (var.name == wanted && var.width == 1) out = var.values;
    return out;
  }
  static float valueOf(const std::vector<float>& list, uint32_t patch) { return list[list.size() > 1 ? patch : 0]; }

  std::vector<float> angle_degrees_, aspect_;
};

/// Spheres: u runs around z, v from pole to pole.
class Spheres : public Particles {
 public:
  using Particles::Particles;

  PatchInfo info(uint32_t) const override { return {.openEdges = 0}; }

  Bound3 bound(uint32_t patch, const UvRect& r) const override {
    const Bound3 sampled = boundOfSamples(r, [&](float u, float v) {
      vec3 outward, byU, byV;
      frame(u, v, outward, byU, byV);
      return points_[patch] + radiusOf(patch) * outward;
    });
    const Bound3 whole = Bound3{points_[patch], points_[patch]}.grown(radiusOf(patch));
    return boundInflated(patch, r, {glm::max(whole.lo, sampled.lo), glm::min(whole.hi, sampled.hi)});
  }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    const float radius = radiusOf(patch);
    for (int i = 0; i < n; ++i) {
      vec3 outward, byU, byV;
      frame(u[i], v[i], outward, byU, byV);
      setFrame(out, i, points_[patch] + radius * outward, radius * byU, radius * byV);
      setNormal(out, i, outward);
    }
  }

 protected:
  double inflation(int nu, int nv) const override { return std::sqrt(4 * M_PI / latticeSphereArea(nu, nv)); }

 private:
  static void frame(float u, float v, vec3& outward, vec3& byU, vec3& byV) {
    float sinU, cosU, sinV, cosV;
    sinCosTurns(0, 1, 1, &u, &sinU, &cosU);
    sinCosTurns(-0.25f, 0.5f, 1, &v, &sinV, &cosV);
    outward = {cosV * cosU, cosV * sinU, sinV};
    byU = 2 * kPi * vec3(-outward.y, outward.x, 0);
    byV = kPi * vec3(-sinV * cosU, -sinV * sinU, cosV);
  }
};

std::string typeOf(const ParamList& params) {
  const Param* type = findParam(params, "type");
  return type && !type->strings.empty() ? type->strings[0] : "particle";
}

}  // namespace

PrimPtr makePoints(const ParamList& params, Problems& problems) {
  std::vector<vec3> points = takePositions(params, Count::AtLeast, 1, problems);
  const size_t n = points.size();
  ParamList others = params;
  std::erase_if(others, [](const Param& p) { return p.name == "type"; });
  std::vector<Primvar> primvars = takePrimvars(others, {1, n, n, n}, problems);
  const std::string type = typeOf(params);
  if (type == "sphere") return std::make_shared<Spheres>(std::move(points), std::move(primvars));
  if (type == "patch") return std::make_shared<Squares>(std::move(points), std::move(primvars));
  if (type != "particle" && type != "disk")
    problems.push_back(fmt::format("points of type \"{}\" are not known: they are disks", type));
  return std::make_shared<Disks>(std::move(points), std::move(primvars));
}

}  // namespace tomales

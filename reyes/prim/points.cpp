// Particles as disks (RISpec 3.2, Points).
#include <fmt/format.h>

#include "reyes/prim/facing.h"
#include "reyes/prim/interpolation.h"
#include "reyes/prim/primvars.h"

namespace tomales {
namespace {

/// The square -1..1 onto the unit disk without a seam (elliptical grid mapping: P. Nowell 2005). Derivatives
/// are parallel at the four corners only.
struct DiskPoint {
  float x, y, xByA, xByB, yByA, yByB;
  DiskPoint(float a, float b) {
    const float sx = std::sqrt(1 - 0.5f * b * b), sy = std::sqrt(1 - 0.5f * a * a);
    x = a * sx, y = b * sy;
    xByA = sx, xByB = -0.5f * a * b / sx;
    yByA = -0.5f * a * b / sy, yByB = sy;
  }
};

struct Disk {
  vec3 center, normal, tangent, bitangent;  ///< Right-handed in this order: tangent, bitangent, normal.
  float radius;
};

class PointCloud : public Prim {
 public:
  PointCloud(std::vector<vec3> points, std::vector<Primvar> primvars)
      : Prim(std::move(primvars)), points_(std::move(points)), width_(widthOf(primvars_)) {}

  std::shared_ptr<const Prim> facing(const vec3& eye, const vec3& forward, bool perspective) const override {
    if (normalsOf(primvars_)) return nullptr;
    auto turned = std::make_shared<PointCloud>(*this);
    turned->eye_ = {eye, forward, perspective};
    return turned;
  }

  uint32_t patchCount() const override { return static_cast<uint32_t>(points_.size()); }
  PatchInfo info(uint32_t) const override { return {}; }

  Bound3 bound(uint32_t patch, const UvRect& r) const override {
    const Disk disk = diskOf(patch);
    const auto range = [](float t0, float t1, float s0, float s1) {  // of t * sqrt(1 - s * s / 2)
      t0 = 2 * t0 - 1, t1 = 2 * t1 - 1, s0 = 2 * s0 - 1, s1 = 2 * s1 - 1;
      const auto factor = [](float s) { return std::sqrt(1 - 0.5f * s * s); };
      const float least = std::min(factor(s0), factor(s1)),
                  most = s0 < 0 && s1 > 0 ? 1 : std::max(factor(s0), factor(s1));
      return vec2(t0 * (t0 < 0 ? most : least), t1 * (t1 > 0 ? most : least));
    };
    const vec2 x = range(r.u0, r.u1, r.v0, r.v1), y = range(r.v0, r.v1, r.u0, r.u1);
    Bound3 bound;
    for (int k = 0; k < 4; ++k)
      bound.extend(disk.center + disk.radius * (x[k & 1] * disk.tangent + y[k >> 1] * disk.bitangent));
    return paddedForRounding(bound, bound);
  }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    const Disk disk = diskOf(patch);
    const auto onDisk = [&](float x, float y) {
      return disk.radius * (x * disk.tangent + y * disk.bitangent);
    };
    for (int i = 0; i < n; ++i) {
      const DiskPoint d(2 * u[i] - 1, 2 * v[i] - 1);
      const vec3 p = disk.center + onDisk(d.x, d.y), du = onDisk(2 * d.xByA, 2 * d.yByA),
                 dv = onDisk(2 * d.xByB, 2 * d.yByB);
      out.px[i] = p.x, out.py[i] = p.y, out.pz[i] = p.z;
      out.dux[i] = du.x, out.duy[i] = du.y, out.duz[i] = du.z;
      out.dvx[i] = dv.x, out.dvy[i] = dv.y, out.dvz[i] = dv.z;
      setNormal(out, i, disk.normal);
    }
  }

  void interpolate(uint32_t patch, int index, int n, const float*, const float*, float* out,
                   int stride) const override {
    const Primvar& var = primvars_[static_cast<size_t>(index)];
    const bool perPoint = var.storage != Storage::Constant && var.storage != Storage::Uniform;
    repeatElement(&var.values[perPoint ? patch * static_cast<size_t>(var.width) : 0], var.width, n, out,
                  stride);
  }

 private:
  Disk diskOf(uint32_t patch) const {
    Disk disk;
    disk.center = points_[patch];
    disk.radius = 0.5f * width_.values[width_.values.size() > 1 ? patch : 0];
    const Primvar* given = normalsOf(primvars_);
    const float* n =
        given ? &given->values[given->values.size() > 3 ? 3 * static_cast<size_t>(patch) : 0] : nullptr;
    disk.normal = normalizeOr(n ? vec3(n[0], n[1], n[2]) : eye_.towards(disk.center), vec3(0, 0, 1));
    orthonormalBasis(disk.normal, disk.tangent, disk.bitangent);
    return disk;
  }

  size_t shapeBytes() const override { return bytesOf(points_) + bytesOf(width_.values); }
  std::vector<vec3> points_;
  Primvar width_;
  Eye eye_;
};

}  // namespace

Primvar widthOf(const std::vector<Primvar>& primvars) {
  const Primvar* found = nullptr;
  for (const char* name : {"constantwidth", "width"})
    for (const Primvar& var : primvars)
      if (var.name == name && var.width == 1) found = &var;
  if (!found) return {"width", Storage::Constant, ValueType::Float, 1, {1.0f}};
  for (float w : found->values)
    if (!(w >= 0 && w < kInfinity)) throw PrimError(fmt::format("{} is {} somewhere", found->name, w));
  return *found;
}

const Primvar* normalsOf(const std::vector<Primvar>& primvars) {
  for (const Primvar& var : primvars)
    if (var.name == "N" && var.width == 3) return &var;
  return nullptr;
}

PrimPtr makePoints(const ParamList& params, Problems& problems) {
  std::vector<vec3> points = takePositions(params, 1, false, problems);
  const size_t n = points.size();
  return std::make_shared<PointCloud>(std::move(points), takePrimvars(params, {1, n, n, n}, problems));
}

}  // namespace tomales

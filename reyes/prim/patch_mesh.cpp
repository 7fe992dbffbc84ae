// Bilinear and bicubic patch meshes (RISpec section 5.2). A Patch is a mesh of one patch.
#include <fmt/format.h>

#include "reyes/prim/patch_mesh.h"
#include "reyes/prim/primvars.h"

namespace tomales {
namespace {

constexpr ToBezier kAsTheyAre{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

/// `span` control points make one patch. Throws PrimError if RISpec's counts do not match.
Direction directionOf(const char* name, int controls, bool periodic, int span, int step) {
  if (step < 1) throw PrimError(fmt::format("the {} step of the basis is {}", name, step));
  if (controls < span)
    throw PrimError(fmt::format("the mesh has {} control points along {}, and a patch needs {}", controls, name, span));
  if (controls > 1 << 20) throw PrimError(fmt::format("the mesh has {} control points along {}", controls, name));
  const int rest = periodic ? controls : controls - span;
  if (rest % step != 0)
    throw PrimError(
        fmt::format("{} control points along {} are no whole number of patches with step {}", controls, name, step));
  return {controls, step, periodic ? rest / step : rest / step + 1, periodic};
}

/// Reads "Pz": heights over the parameter square (RISpec section 5.2).
std::vector<vec3> takeHeights(const Param& heights, const Layout& mesh) {
  if (heights.floats.size() != mesh.controls())
    throw PrimError(fmt::format("Pz has {} values where {} vertices need {} floats", heights.floats.size(),
                                mesh.controls(), mesh.controls()));
  const auto along = [](int i, const Direction& d) {
    return static_cast<float>(i) / static_cast<float>(d.periodic ? d.controls : d.controls - 1);
  };
  std::vector<vec3> points;
  for (int j = 0; j < mesh.v.controls; ++j)
    for (int i = 0; i < mesh.u.controls; ++i) {
      points.emplace_back(along(i, mesh.u), along(j, mesh.v), heights.floats[points.size()]);
      if (!isFinite(points.back()))
        throw PrimError(fmt::format("Pz of vertex {} is not a finite number", points.size() - 1));
    }
  return points;
}

std::vector<vec3> takeControls(const ParamList& params, const Layout& mesh, Problems& problems) {
  const Param* heights = findParam(params, "Pz");
  return heights ? takeHeights(*heights, mesh) : takePositions(params, Count::Exactly, mesh.controls(), problems);
}

class BilinearMesh : public PatchMesh {
 public:
  BilinearMesh(const Layout& mesh, const ParamList& params, Problems& problems)
      : PatchMesh(mesh, params, problems), points_(takeControls(params, mesh, problems)) {}

  PatchInfo info(uint32_t patch) const override {
    const auto edge = [&](uint32_t p, PatchEdge bit) { return endsOf(corners(p), bit); };
    return {isFlat(corners(patch)), findOpenEdges(patch, edge)};
  }
  std::optional<std::array<vec3, 2>> straightEdge(uint32_t patch, PatchEdge edge) const override {
    return endsOf(corners(patch), edge);
  }

  Bound3 bound(uint32_t patch, const UvRect& rect) const override { return boundBilinear(corners(patch), rect); }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    const std::array<vec3, 4> c = corners(patch);
    evaluateBilinear(c, n, u, v, out);
    const vec3 across = cross(c[3] - c[0], c[2] - c[1]);
    const float degenerate = 1e-6f * glm::length(c[3] - c[0]) * glm::length(c[2] - c[1]);
    for (int i = 0; i < n; ++i)
      if (!(glm::length(normalOf(out, i)) > degenerate)) setNormal(out, i, normalizeOr(across, {0, 0, 1}));
  }

 protected:
  void interpolateVertex(uint32_t patch, const Primvar& var, int n, const float* u, const float* v, float* out,
                         int stride) const override {
    interpolateBilinear(var.values.data(), var.width, mesh_.cornersOf(patch), n, u, v, out, stride);
  }

 private:
  std::array<vec3, 4> corners(uint32_t patch) const {
    const Corners c = mesh_.cornersOf(patch);
    return {points_[c[0]], points_[c[1]], points_[c[2]], points_[c[3]]};
  }

  static bool isFlat(const std::array<vec3, 4>& c) {
    const vec3 normal = normalizeOr(cross(c[3] - c[0], c[2] - c[1]), vec3(0));
    return std::abs(dot(normal, c[1] - c[0])) <= 1e-6f * glm::length(c[3] - c[0]);
  }

  size_t shapeBytes() const override { return bytesOf(points_); }
  std::vector<vec3> points_;
};

class BicubicMesh : public PatchMesh {
 public:
  BicubicMesh(const Layout& mesh, const Basis& uBasis, const Basis& vBasis, const ParamList& params, Problems& problems)
      : PatchMesh(mesh, params, problems), uToBezier_(bezierFrom(uBasis)), vToBezier_(bezierFrom(vBasis)) {
    const std::vector<vec3> controls = takeControls(params, mesh, problems);
    patches_.reserve(mesh.patches());
    for (uint32_t patch = 0; patch < mesh.patches(); ++patch)
      patches_.push_back({net(patch, &controls[0].x, 3), net(patch, &controls[0].y, 3), net(patch, &controls[0].z, 3)});
  }

  PatchInfo info(uint32_t patch) const override {
    const auto edge = [&](uint32_t p, PatchEdge bit) {
      const size_t first = bit == kEdgeU1   ? 3
                           : bit == kEdgeV1 ? 12
                                            : 0,
                   step = bit == kEdgeU0 || bit == kEdgeU1 ? 4 : 1;
      std::array<vec3, 4> points;
      for (size_t k = 0; k < 4; ++k) {
        const size_t c = first + k * step;
        points[k] = {patches_[p][0][c], patches_[p][1][c], patches_[p][2][c]};
      }
      return points;
    };
    return {false, findOpenEdges(patch, edge)};
  }

  Bound3 bound(uint32_t patch, const UvRect& rect) const override { return boundBicubic(patches_[patch], rect); }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    evaluateBicubic(patches_[patch], n, u, v, out);
  }

 protected:
  void interpolateVertex(uint32_t patch, const Primvar& var, int n, const float* u, const float* v, float* out,
                         int stride) const override {
    for (int c = 0; c < var.width; ++c)
      evaluateNet(net(patch, &var.values[static_cast<size_t>(c)], var.width), n, u, v,
                  out + static_cast<ptrdiff_t>(c) * stride);
  }

 private:
  BezierNet net(uint32_t patch, const float* values, int width) const {
    BezierNet control;
    size_t n = 0;
    for (int l = 0; l < 4; ++l)
      for (int k = 0; k < 4; ++k) control[n++] = values[mesh_.controlOf(patch, k, l) * static_cast<size_t>(width)];
    return convertNet(control, uToBezier_, vToBezier_);
  }

  size_t shapeBytes() const override { return bytesOf(patches_); }
  const ToBezier uToBezier_, vToBezier_;
  std::vector<BezierPatch> patches_;
};

}  // namespace

PrimPtr makeBilinearPatchMesh(int nu, bool uPeriodic, int nv, bool vPeriodic, const ParamList& params,
                              Problems& problems) {
  const Layout mesh{directionOf("u", nu, uPeriodic, 2, 1), directionOf("v", nv, vPeriodic, 2, 1)};
  if (isRational(params)) return makeRationalMesh(mesh, 2, kAsTheyAre, kAsTheyAre, params, problems);
  return std::make_shared<BilinearMesh>(mesh, params, problems);
}

PrimPtr makeBicubicPatchMesh(int nu, bool uPeriodic, const Basis& uBasis, int nv, bool vPeriodic, const Basis& vBasis,
                             const ParamList& params, Problems& problems) {
  const Layout mesh{directionOf("u", nu, uPeriodic, 4, uBasis.step), directionOf("v", nv, vPeriodic, 4, vBasis.step)};
  if (isRational(params)) return makeRationalMesh(mesh, 4, bezierFrom(uBasis), bezierFrom(vBasis), params, problems);
  return std::make_shared<BicubicMesh>(mesh, uBasis, vBasis, params, problems);
}

}  // namespace tomales

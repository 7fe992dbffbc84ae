// Bilinear and bicubic patch meshes (RISpec section 5.2). A Patch is a mesh of one.
#include <fmt/format.h>

#include "reyes/prim/bicubic.h"
#include "reyes/prim/interpolation.h"
#include "reyes/prim/primvars.h"

namespace tomales {
namespace {

/// One direction of a mesh.
struct Direction {
  int controls, step, patches;
  bool periodic;
  int corners() const { return periodic ? patches : patches + 1; }  ///< Varying values.
};

struct Layout {
  Direction u, v;
  uint32_t patches() const { return static_cast<uint32_t>(u.patches) * static_cast<uint32_t>(v.patches); }
  size_t controls() const { return static_cast<size_t>(u.controls) * v.controls; }
  size_t corners() const { return static_cast<size_t>(u.corners()) * v.corners(); }
  PrimvarCounts counts() const { return {patches(), corners(), controls(), corners()}; }

  /// Numbers of the varying values at a patch's corners.
  Corners cornersOf(uint32_t patch) const {
    const int i = static_cast<int>(patch) % u.patches, j = static_cast<int>(patch) / u.patches;
    const auto number = [&](int du, int dv) {
      return static_cast<uint32_t>((j + dv) % v.corners() * u.corners() + (i + du) % u.corners());
    };
    return {number(0, 0), number(1, 0), number(0, 1), number(1, 1)};
  }
  /// Number of control (k, l) of a patch.
  size_t controlOf(uint32_t patch, int k, int l) const {
    const int i = static_cast<int>(patch) % u.patches, j = static_cast<int>(patch) / u.patches;
    return static_cast<size_t>((j * v.step + l) % v.controls) * u.controls + (i * u.step + k) % u.controls;
  }
  /// The neighbour across an edge, around the mesh whether or not it is periodic.
  uint32_t neighbour(uint32_t patch, int du, int dv) const {
    const int i = static_cast<int>(patch) % u.patches, j = static_cast<int>(patch) / u.patches;
    return static_cast<uint32_t>((j + dv + v.patches) % v.patches * u.patches +
                                 (i + du + u.patches) % u.patches);
  }
};

/// `span` control points make one patch. Throws where RISpec's counts do not come out.
Direction directionOf(const char* name, int controls, bool periodic, int span, int step) {
  if (step < 1) throw PrimError(fmt::format("the {} step of the basis is {}", name, step));
  if (controls < span)
    throw PrimError(
        fmt::format("the mesh has {} control points along {}, and a patch needs {}", controls, name, span));
  if (controls > 1 << 20)
    throw PrimError(fmt::format("the mesh has {} control points along {}", controls, name));
  const int rest = periodic ? controls : controls - span;
  if (rest % step != 0)
    throw PrimError(fmt::format("{} control points along {} are no whole number of patches with step {}",
                                controls, name, step));
  return {controls, step, periodic ? rest / step : rest / step + 1, periodic};
}

/// "Pz": heights over the parameter square (RISpec section 5.2).
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
  return heights ? takeHeights(*heights, mesh) : takePositions(params, mesh.controls(), true, problems);
}

class PatchMesh : public Prim {
 public:
  uint32_t patchCount() const override { return mesh_.patches(); }

  void surfaceParameters(uint32_t patch, int n, const float* u, const float* v, float* su,
                         float* sv) const override {
    const float i = static_cast<float>(static_cast<int>(patch) % mesh_.u.patches),
                nu = static_cast<float>(mesh_.u.patches);
    const float j = static_cast<float>(static_cast<int>(patch) / mesh_.u.patches),
                nv = static_cast<float>(mesh_.v.patches);
    for (int k = 0; k < n; ++k) su[k] = (i + u[k]) / nu, sv[k] = (j + v[k]) / nv;
  }

  void interpolate(uint32_t patch, int index, int n, const float* u, const float* v, float* out,
                   int stride) const override {
    const Primvar& var = primvars_[static_cast<size_t>(index)];
    if (repeatIfEven(var, patch, n, out, stride)) return;
    if (var.storage == Storage::Vertex)
      interpolateVertex(patch, var, n, u, v, out, stride);
    else
      interpolateBilinear(var.values.data(), var.width, mesh_.cornersOf(patch), n, u, v, out, stride);
  }

 protected:
  PatchMesh(const Layout& mesh, const ParamList& params, Problems& problems)
      : Prim(takePrimvars(params, mesh.counts(), problems)), mesh_(mesh) {}

  virtual void interpolateVertex(uint32_t patch, const Primvar& var, int n, const float* u, const float* v,
                                 float* out, int stride) const = 0;

  /// An edge is closed if it is a point, or if it is the opposite edge of the patch next to it: in a mesh
  /// that is not periodic but ends where it began, too. edge(patch, bit) lists its control points.
  template <class EdgeOf>
  uint8_t findOpenEdges(uint32_t patch, const EdgeOf& edge) const {
    struct Side {
      PatchEdge mine, theirs;
      int du, dv;
    };
    static constexpr Side kSides[] = {{kEdgeU0, kEdgeU1, -1, 0},
                                      {kEdgeU1, kEdgeU0, 1, 0},
                                      {kEdgeV0, kEdgeV1, 0, -1},
                                      {kEdgeV1, kEdgeV0, 0, 1}};
    int open = 0;
    for (const Side& side : kSides) {
      const auto mine = edge(patch, side.mine);
      const bool isPoint = std::equal(mine.begin() + 1, mine.end(), mine.begin());
      if (!isPoint && mine != edge(mesh_.neighbour(patch, side.du, side.dv), side.theirs)) open |= side.mine;
    }
    return static_cast<uint8_t>(open);
  }

  const Layout mesh_;
};

class BilinearMesh : public PatchMesh {
 public:
  BilinearMesh(const Layout& mesh, const ParamList& params, Problems& problems)
      : PatchMesh(mesh, params, problems), points_(takeControls(params, mesh, problems)) {}

  PatchInfo info(uint32_t patch) const override {
    const auto edge = [&](uint32_t p, PatchEdge bit) {
      const std::array<vec3, 4> c = corners(p);
      return bit == kEdgeU0   ? std::array{c[0], c[2]}
             : bit == kEdgeU1 ? std::array{c[1], c[3]}
             : bit == kEdgeV0 ? std::array{c[0], c[1]}
                              : std::array{c[2], c[3]};
    };
    return {isFlat(corners(patch)), findOpenEdges(patch, edge)};
  }

  Bound3 bound(uint32_t patch, const UvRect& rect) const override {
    return boundBilinear(corners(patch), rect);
  }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    const std::array<vec3, 4> c = corners(patch);
    evaluateBilinear(c, n, u, v, out);
    const vec3 across = cross(c[3] - c[0], c[2] - c[1]);
    const float degenerate = 1e-6f * glm::length(c[3] - c[0]) * glm::length(c[2] - c[1]);
    for (int i = 0; i < n; ++i)
      if (!(glm::length(normalOf(out, i)) > degenerate)) setNormal(out, i, normalizeOr(across, {0, 0, 1}));
  }

 protected:
  void interpolateVertex(uint32_t patch, const Primvar& var, int n, const float* u, const float* v,
                         float* out, int stride) const override {
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
  BicubicMesh(const Layout& mesh, const Basis& uBasis, const Basis& vBasis, const ParamList& params,
              Problems& problems)
      : PatchMesh(mesh, params, problems), uToBezier_(bezierFrom(uBasis)), vToBezier_(bezierFrom(vBasis)) {
    const std::vector<vec3> controls = takeControls(params, mesh, problems);
    patches_.reserve(mesh.patches());
    for (uint32_t patch = 0; patch < mesh.patches(); ++patch)
      patches_.push_back(
          {net(patch, &controls[0].x, 3), net(patch, &controls[0].y, 3), net(patch, &controls[0].z, 3)});
  }

  PatchInfo info(uint32_t patch) const override {
    const auto edge = [&](uint32_t p, PatchEdge bit) {
      const int first = bit == kEdgeU1   ? 3
                        : bit == kEdgeV1 ? 12
                                         : 0,
                step = bit == kEdgeU0 || bit == kEdgeU1 ? 4 : 1;
      std::array<vec3, 4> points;
      for (int k = 0; k < 4; ++k) {
        const int c = first + k * step;
        points[k] = {patches_[p][0][c], patches_[p][1][c], patches_[p][2][c]};
      }
      return points;
    };
    return {false, findOpenEdges(patch, edge)};
  }

  Bound3 bound(uint32_t patch, const UvRect& rect) const override {
    return boundBicubic(patches_[patch], rect);
  }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    evaluateBicubic(patches_[patch], n, u, v, out);
  }

 protected:
  void interpolateVertex(uint32_t patch, const Primvar& var, int n, const float* u, const float* v,
                         float* out, int stride) const override {
    for (int c = 0; c < var.width; ++c)
      evaluateNet(net(patch, &var.values[static_cast<size_t>(c)], var.width), n, u, v,
                  out + static_cast<ptrdiff_t>(c) * stride);
  }

 private:
  BezierNet net(uint32_t patch, const float* values, int width) const {
    BezierNet control;
    for (int l = 0; l < 4; ++l)
      for (int k = 0; k < 4; ++k)
        control[4 * l + k] = values[mesh_.controlOf(patch, k, l) * static_cast<size_t>(width)];
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
  return std::make_shared<BilinearMesh>(mesh, params, problems);
}

PrimPtr makeBicubicPatchMesh(int nu, bool uPeriodic, const Basis& uBasis, int nv, bool vPeriodic,
                             const Basis& vBasis, const ParamList& params, Problems& problems) {
  const Layout mesh{directionOf("u", nu, uPeriodic, 4, uBasis.step),
                    directionOf("v", nv, vPeriodic, 4, vBasis.step)};
  return std::make_shared<BicubicMesh>(mesh, uBasis, vBasis, params, problems);
}

}  // namespace tomales

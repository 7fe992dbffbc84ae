// Private to patch meshes: the indices of controls and values, and which edges meet.
#pragma once
#include "reyes/prim/bicubic.h"
#include "reyes/prim/interpolation.h"

namespace tomales {

/// One direction of a mesh.
struct Direction {
  int controls, step, patches;
  bool periodic;
  int corners() const { return periodic ? patches : patches + 1; }  ///< Number of varying values.
};

struct Layout {
  Direction u, v;
  uint32_t patches() const { return static_cast<uint32_t>(u.patches) * static_cast<uint32_t>(v.patches); }
  size_t controls() const { return static_cast<size_t>(u.controls) * static_cast<size_t>(v.controls); }
  size_t corners() const { return static_cast<size_t>(u.corners()) * static_cast<size_t>(v.corners()); }
  PrimvarCounts counts() const { return {patches(), corners(), controls(), corners()}; }

  /// Returns the indices of the varying values at a patch's corners.
  Corners cornersOf(uint32_t patch) const {
    const int i = static_cast<int>(patch) % u.patches, j = static_cast<int>(patch) / u.patches;
    const auto number = [&](int du, int dv) {
      return static_cast<uint32_t>((j + dv) % v.corners() * u.corners() + (i + du) % u.corners());
    };
    return {number(0, 0), number(1, 0), number(0, 1), number(1, 1)};
  }
  /// Returns the index of control (k, l) of a patch.
  size_t controlOf(uint32_t patch, int k, int l) const {
    const int i = static_cast<int>(patch) % u.patches, j = static_cast<int>(patch) / u.patches;
    const int row = (j * v.step + l) % v.controls, column = (i * u.step + k) % u.controls;
    return static_cast<size_t>(row) * static_cast<size_t>(u.controls) + static_cast<size_t>(column);
  }
  /// Returns the neighbour across an edge, around the mesh whether or not it is periodic.
  uint32_t neighbour(uint32_t patch, int du, int dv) const {
    const int i = static_cast<int>(patch) % u.patches, j = static_cast<int>(patch) / u.patches;
    return static_cast<uint32_t>((j + dv + v.patches) % v.patches * u.patches + (i + du + u.patches) % u.patches);
  }
};

class PatchMesh : public Prim {
 public:
  uint32_t patchCount() const override { return mesh_.patches(); }

  void surfaceParameters(uint32_t patch, int n, const float* u, const float* v, float* su, float* sv) const override {
    const float i = static_cast<float>(static_cast<int>(patch) % mesh_.u.patches),
                nu = static_cast<float>(mesh_.u.patches);
    const float j = static_cast<float>(static_cast<int>(patch) / mesh_.u.patches),
                nv = static_cast<float>(mesh_.v.patches);
    for (int k = 0; k < n; ++k) {
      su[k] = (i + u[k]) / nu;
      sv[k] = (j + v[k]) / nv;
    }
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

  virtual void interpolateVertex(uint32_t patch, const Primvar& var, int n, const float* u, const float* v, float* out,
                                 int stride) const = 0;

  /// Finds the edges that are not closed. An edge is closed if it is a point, or if it equals the adjoining edge of the
  /// next patch, also in a mesh that ends where it began but is not periodic. edge(patch, bit) lists the control points
  /// of an edge.
  template <class EdgeOf>
  uint8_t findOpenEdges(uint32_t patch, const EdgeOf& edge) const {
    struct Side {
      PatchEdge mine, theirs;
      int du, dv;
    };
    static constexpr Side kSides[] = {
        {kEdgeU0, kEdgeU1, -1, 0}, {kEdgeU1, kEdgeU0, 1, 0}, {kEdgeV0, kEdgeV1, 0, -1}, {kEdgeV1, kEdgeV0, 0, 1}};
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

/// Makes rational patches, for "Pw" with different weights. The two matrices convert `order` controls along either side
/// of a patch to those of a Bezier patch. Vertex primvars are weighted like positions. Throws PrimError unless all
/// Bezier weights are positive.
PrimPtr makeRationalMesh(const Layout& mesh, int order, const ToBezier& u, const ToBezier& v, const ParamList& params,
                         Problems& problems);
/// Tells whether the parameters ask for a rational mesh.
bool isRational(const ParamList& params);

}  // namespace tomales

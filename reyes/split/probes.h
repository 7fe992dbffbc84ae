// Private to splitting: measures patches by a lattice of points on each, the probes. Lines of the lattice are measured
// chord by chord, for a vector of patches at once, because scenes with many patches have small ones.
#pragma once
#include "reyes/base/simd.h"
#include "reyes/scene.h"

namespace tomales {

/// Probes of kPatches patches; point k of all of them is adjacent. Rows of points run along u.
template <int kProbesT, int kPatchesT>
struct ProbeLattice {
  static constexpr int kProbes = kProbesT, kPatches = kPatchesT, kRow = kProbes + 1, kCount = kRow * kRow;
  using Values = float[size_t{kCount}][size_t{kPatches}];
  alignas(64) Values x, y, z;  ///< Positions in camera space.
  alignas(64) Values rasterX, rasterY;
};

/// PatchSize of kPatches patches.
template <int kPatches>
struct ProbeSizes {
  using Values = float[size_t{kPatches}];
  struct Line {
    alignas(64) Values px, length, bend_px;
    alignas(64) int least[size_t{kPatches}];
  };
  Line u, v;
  alignas(64) Values area_px2;
  alignas(64) Values lo[3], hi[3];
};

/// Transforms the probes from object space to camera space and raster space, and measures the lines through them.
/// `asSeen`: lengths and areas are measured as projected; if false, as if they faced the camera.
void measureLattice(ProbeLattice<1, kLanes>& at, const mat4& cameraFromObject, const Camera& camera, bool asSeen,
                    ProbeSizes<kLanes>& out);
void measureLattice(ProbeLattice<4, kLanes>& at, const mat4& cameraFromObject, const Camera& camera, bool asSeen,
                    ProbeSizes<kLanes>& out);
void measureLattice(ProbeLattice<1, 1>& at, const mat4& cameraFromObject, const Camera& camera, bool asSeen,
                    ProbeSizes<1>& out);
void measureLattice(ProbeLattice<4, 1>& at, const mat4& cameraFromObject, const Camera& camera, bool asSeen,
                    ProbeSizes<1>& out);

}  // namespace tomales

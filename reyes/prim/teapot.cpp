// Geometry "teapot": 32 bicubic Bezier patches (M. Newell, "The Utilization of Procedure Models in Digital Image
// Synthesis", 1975). It stands on z = 0 and pours towards x.
#include "reyes/prim/bicubic.h"
#include "reyes/prim/interpolation.h"

namespace tomales {
namespace {

// A quarter of the round parts and half of the others; the rest are reflections.
constexpr float kPoints[][3] = {
    {0.2f, 0, 2.7f},
    {0.2f, -0.112f, 2.7f},
    {0.112f, -0.2f, 2.7f},
    {0, -0.2f, 2.7f},
    {1.3375f, 0, 2.53125f},
    {1.3375f, -0.749f, 2.53125f},
    {0.749f, -1.3375f, 2.53125f},
    {0, -1.3375f, 2.53125f},
    {1.4375f, 0, 2.53125f},
    {1.4375f, -0.805f, 2.53125f},
    {0.805f, -1.4375f, 2.53125f},
    {0, -1.4375f, 2.53125f},
    {1.5f, 0, 2.4f},
    {1.5f, -0.84f, 2.4f},
    {0.84f, -1.5f, 2.4f},
    {0, -1.5f, 2.4f},
    {1.75f, 0, 1.875f},
    {1.75f, -0.98f, 1.875f},
    {0.98f, -1.75f, 1.875f},
    {0, -1.75f, 1.875f},
    {2, 0, 1.35f},
    {2, -1.12f, 1.35f},
    {1.12f, -2, 1.35f},
    {0, -2, 1.35f},
    {2, 0, 0.9f},
    {2, -1.12f, 0.9f},
    {1.12f, -2, 0.9f},
    {0, -2, 0.9f},
    {-2, 0, 0.9f},
    {2, 0, 0.45f},
    {2, -1.12f, 0.45f},
    {1.12f, -2, 0.45f},
    {0, -2, 0.45f},
    {1.5f, 0, 0.225f},
    {1.5f, -0.84f, 0.225f},
    {0.84f, -1.5f, 0.225f},
    {0, -1.5f, 0.225f},
    {1.5f, 0, 0.15f},
    {1.5f, -0.84f, 0.15f},
    {0.84f, -1.5f, 0.15f},
    {0, -1.5f, 0.15f},
    {-1.6f, 0, 2.025f},
    {-1.6f, -0.3f, 2.025f},
    {-1.5f, -0.3f, 2.25f},
    {-1.5f, 0, 2.25f},
    {-2.3f, 0, 2.025f},
    {-2.3f, -0.3f, 2.025f},
    {-2.5f, -0.3f, 2.25f},
    {-2.5f, 0, 2.25f},
    {-2.7f, 0, 2.025f},
    {-2.7f, -0.3f, 2.025f},
    {-3, -0.3f, 2.25f},
    {-3, 0, 2.25f},
    {-2.7f, 0, 1.8f},
    {-2.7f, -0.3f, 1.8f},
    {-3, -0.3f, 1.8f},
    {-3, 0, 1.8f},
    {-2.7f, 0, 1.575f},
    {-2.7f, -0.3f, 1.575f},
    {-3, -0.3f, 1.35f},
    {-3, 0, 1.35f},
    {-2.5f, 0, 1.125f},
    {-2.5f, -0.3f, 1.125f},
    {-2.65f, -0.3f, 0.9375f},
    {-2.65f, 0, 0.9375f},
    {-2, -0.3f, 0.9f},
    {-1.9f, -0.3f, 0.6f},
    {-1.9f, 0, 0.6f},
    {1.7f, 0, 1.425f},
    {1.7f, -0.66f, 1.425f},
    {1.7f, -0.66f, 0.6f},
    {1.7f, 0, 0.6f},
    {2.6f, 0, 1.425f},
    {2.6f, -0.66f, 1.425f},
    {3.1f, -0.66f, 0.825f},
    {3.1f, 0, 0.825f},
    {2.3f, 0, 2.1f},
    {2.3f, -0.25f, 2.1f},
    {2.4f, -0.25f, 2.025f},
    {2.4f, 0, 2.025f},
    {2.7f, 0, 2.4f},
    {2.7f, -0.25f, 2.4f},
    {3.3f, -0.25f, 2.4f},
    {3.3f, 0, 2.4f},
    {2.8f, 0, 2.475f},
    {2.8f, -0.25f, 2.475f},
    {3.525f, -0.25f, 2.49375f},
    {3.525f, 0, 2.49375f},
    {2.9f, 0, 2.475f},
    {2.9f, -0.15f, 2.475f},
    {3.45f, -0.15f, 2.5125f},
    {3.45f, 0, 2.5125f},
    {2.8f, 0, 2.4f},
    {2.8f, -0.15f, 2.4f},
    {3.2f, -0.15f, 2.4f},
    {3.2f, 0, 2.4f},
    {0, 0, 3.15f},
    {0.8f, 0, 3.15f},
    {0.8f, -0.45f, 3.15f},
    {0.45f, -0.8f, 3.15f},
    {0, -0.8f, 3.15f},
    {0, 0, 2.85f},
    {1.4f, 0, 2.4f},
    {1.4f, -0.784f, 2.4f},
    {0.784f, -1.4f, 2.4f},
    {0, -1.4f, 2.4f},
    {0.4f, 0, 2.55f},
    {0.4f, -0.224f, 2.55f},
    {0.224f, -0.4f, 2.55f},
    {0, -0.4f, 2.55f},
    {1.3f, 0, 2.55f},
    {1.3f, -0.728f, 2.55f},
    {0.728f, -1.3f, 2.55f},
    {0, -1.3f, 2.55f},
    {1.3f, 0, 2.4f},
    {1.3f, -0.728f, 2.4f},
    {0.728f, -1.3f, 2.4f},
    {0, -1.3f, 2.4f},
    {0, 0, 0},
    {1.425f, -0.798f, 0},
    {1.5f, 0, 0.075f},
    {1.425f, 0, 0},
    {0.798f, -1.425f, 0},
    {0, -1.5f, 0.075f},
    {0, -1.425f, 0},
    {1.5f, -0.84f, 0.075f},
    {0.84f, -1.5f, 0.075f},
};
constexpr int kPatches[][16] = {
    {102, 103, 104, 105, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15},                // rim
    {12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27},              // body
    {24, 25, 26, 27, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40},              // body
    {96, 96, 96, 96, 97, 98, 99, 100, 101, 101, 101, 101, 0, 1, 2, 3},             // lid
    {0, 1, 2, 3, 106, 107, 108, 109, 110, 111, 112, 113, 114, 115, 116, 117},      // lid
    {118, 118, 118, 118, 124, 122, 119, 121, 123, 126, 125, 120, 40, 39, 38, 37},  // bottom
    {41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56},              // handle
    {53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 28, 65, 66, 67},              // handle
    {68, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78, 79, 80, 81, 82, 83},              // spout
    {80, 81, 82, 83, 84, 85, 86, 87, 88, 89, 90, 91, 92, 93, 94, 95},              // spout
};
constexpr int kRoundPatch = 6;  ///< Number of the first patches, which are quarters.

/// Returns a patch reflected at x = 0, at y = 0 or both, with the outside out.
BezierPatch reflected(const int (&controls)[16], bool atX, bool atY) {
  BezierPatch patch;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const float* p = kPoints[controls[4 * row + (atX == atY ? column : 3 - column)]];
      const size_t k = static_cast<size_t>(4 * row + column);
      patch[0][k] = atX ? -p[0] : p[0];
      patch[1][k] = atY ? -p[1] : p[1];
      patch[2][k] = p[2];
    }
  return patch;
}

using Edge = std::array<vec3, 4>;

/// Returns the edges in the order of the bits of PatchEdge.
std::array<Edge, 4> edgesOf(const BezierPatch& patch) {
  static constexpr int kFirst[] = {0, 3, 0, 12}, kStep[] = {4, 4, 1, 1};
  std::array<Edge, 4> edges;
  for (size_t e = 0; e < 4; ++e)
    for (size_t k = 0; k < 4; ++k) {
      const size_t at = static_cast<size_t>(kFirst[e]) + k * static_cast<size_t>(kStep[e]);
      edges[e][k] = {patch[0][at], patch[1][at], patch[2][at]};
    }
  return edges;
}

class Teapot : public Prim {
 public:
  Teapot(const ParamList& params, Problems& problems) : Prim(takePrimvars(params, {}, problems)) {
    for (int k = 0; k < static_cast<int>(std::size(kPatches)); ++k)
      for (const bool atY : {false, true}) {
        patches_.push_back(reflected(kPatches[k], false, atY));
        if (k < kRoundPatch) patches_.push_back(reflected(kPatches[k], true, atY));
      }
    for (const BezierPatch& patch : patches_) openEdges_.push_back(openEdges(patch));
  }

  uint32_t patchCount() const override { return static_cast<uint32_t>(patches_.size()); }
  PatchInfo info(uint32_t patch) const override { return {.openEdges = openEdges_[patch]}; }
  Bound3 bound(uint32_t patch, const UvRect& rect) const override { return boundBicubic(patches_[patch], rect); }
  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    evaluateBicubic(patches_[patch], n, u, v, out);
  }
  void interpolate(uint32_t, int index, int n, const float* u, const float* v, float* out, int stride) const override {
    const Primvar& var = primvars_[static_cast<size_t>(index)];
    if (!repeatIfEven(var, 0, n, out, stride))
      interpolateBilinear(var.values.data(), var.width, {0, 1, 2, 3}, n, u, v, out, stride);
  }

 private:
  uint8_t openEdges(const BezierPatch& patch) const {
    int open = 0;
    const std::array<Edge, 4> edges = edgesOf(patch);
    for (size_t e = 0; e < 4; ++e) {
      const Edge back{edges[e][3], edges[e][2], edges[e][1], edges[e][0]};
      const auto joins = [&](const BezierPatch& other) {
        if (&other == &patch) return false;
        const std::array<Edge, 4> theirs = edgesOf(other);
        return std::any_of(theirs.begin(), theirs.end(), [&](const Edge& t) { return t == edges[e] || t == back; });
      };
      const bool isPoint = edges[e][0] == edges[e][1] && edges[e][1] == edges[e][2] && edges[e][2] == edges[e][3];
      if (!isPoint && std::none_of(patches_.begin(), patches_.end(), joins)) open |= 1 << e;
    }
    return static_cast<uint8_t>(open);
  }

  std::vector<BezierPatch> patches_;
  std::vector<uint8_t> openEdges_;
};

}  // namespace

PrimPtr makeTeapot(const ParamList& params, Problems& problems) { return std::make_shared<Teapot>(params, problems); }

}  // namespace tomales

// Private to the primitives: surfaces of revolution about z. All seven quadrics (RISpec section 5.4) are such surfaces,
// each with its own meridian.
#pragma once
#include <array>

#include "reyes/prim_factories.h"

namespace tomales {

/// The meridian at parameter v, in the half-plane theta = 0 (a hyperboloid's has a y as well).
struct Meridian {
  static constexpr int kChunk = 128;
  float x[kChunk], y[kChunk], z[kChunk];
  float dx[kChunk], dy[kChunk], dz[kChunk];  ///< Derivatives by v.
  /// Normals in the direction of dPdu x dPdv for a positive sweep; never zero.
  float nx[kChunk], ny[kChunk], nz[kChunk];
};

/// Computes sin and cos of 2 pi (offset + frac(scale * t)). The angle is counted in turns, so that a closed sweep ends
/// on the very bits that it began with, and quarter turns are exact.
void sinCosTurns(float offset, float scale, int n, const float* t, float* sine, float* cosine);

class Revolution : public Prim {
 public:
  uint32_t patchCount() const override { return 1; }
  PatchInfo info(uint32_t) const override { return {false, openEdges_}; }
  Bound3 bound(uint32_t, const UvRect& rect) const override;
  void evaluate(uint32_t, int n, const float* u, const float* v, SurfacePoints out) const override;
  void interpolate(uint32_t, int index, int n, const float* u, const float* v, float* out, int stride) const override;

 protected:
  /// Throws PrimError for a sweep without area.
  Revolution(float thetaMax_degrees, const ParamList& params, Problems& problems);

  /// Fills n <= kChunk entries.
  virtual void meridian(int n, const float* v, Meridian& out) const = 0;

  /// Returns two points that bound the meridian from v0 to v1: each of its points lies between them in (x,y) and in z.
  virtual std::array<vec3, 2> meridianHull(float v0, float v1) const = 0;

  bool isClosed() const { return std::abs(sweep_turns_) == 1; }

  /// Marks edges as closed: those that are poles or join the opposite edge.
  void close(int edges) { openEdges_ = static_cast<uint8_t>(openEdges_ & ~edges); }

 private:
  float sweep_turns_;
  uint8_t openEdges_ = kAllEdges;
};

}  // namespace tomales

// Private to gi: where the light of a batch of points is gathered, and in which order the gather pass visits pixels.
// Space: current.
#pragma once
#include "gi/frame/state.h"

namespace tomales {

/// Root of the area that a pixel projects onto the plane through P with unit normal n (Tabellion and Lamorlette 2004,
/// section 4.5).
float projectedPixelSize(const Camera&, const vec3& P, const vec3& n);

/// The places where the indirect light of a batch is gathered and looked up (Tabellion and Lamorlette 2004,
/// section 4.5): its points, or the values of its primitive variable "gatherP", on the side of the normal without bumps
/// or of "gatherN". Points with equal values share a place, as all points of one hair share its root.
class GatherPlaces {
 public:
  GatherPlaces(const GiState&, const ShadePoints&);
  GatherPoint at(int i) const;
  /// Returns the place at(i), without what only rays need. `normal`: the shading normal.
  IrradiancePlace lookupAt(int i, const vec3& normal) const;
  /// Returns the normal that records are extrapolated to: the shading normal, unless "gatherN" names another.
  vec3 shading(int i, const vec3& normal) const { return normals_ < 0 ? normal : this->normal(i); }
  /// Sets the start of a ray along its direction from place i, at a time of the shutter.
  void startRay(const RayScene&, int i, float time, Ray&) const;

 private:
  vec3 normal(int i) const;
  vec3 named(int offset, int i) const;

  const GiState& state_;
  const ShadePoints& points_;
  int positions_, normals_;  ///< Offsets of the primitive variables; -1: the group has none.
  bool bumped_;
};

/// Phase of the gather pass in which the nearest point of a pixel is considered: 0 is a lattice of stride 16,
/// and each phase after it halves the area for each point, down to every pixel (quincunx first, then the rest
/// of the finer lattice).
constexpr int kLatticePhases = 9;
int latticePhase(int x, int y);

}  // namespace tomales

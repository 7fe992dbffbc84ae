// Disks as lattices. Private to the primitives.
#pragma once
#include "reyes/prim.h"

namespace tomales {

struct Disk {
  vec3 center, normal, tangent, bitangent;  ///< Right-handed in this order: tangent, bitangent, normal.
  float radius;
};

/// Area of the polygon that a lattice of nu x nv makes of the unit disk.
double latticeDiskArea(int nu, int nv);

/// The disk over the unit square, without a seam; derivatives are parallel at the four corners only.
void evaluateDisk(const Disk& disk, int n, const float* u, const float* v, const SurfacePoints& out);

/// The same at the four corners, which lie farther from the centre by `more` of their distance.
void evaluateDot(const Disk& disk, float more, const SurfacePoints& out);

}  // namespace tomales

// Private to the primitives: maps the unit square to disks, so that grids can cover them.
#pragma once
#include "reyes/prim.h"

namespace tomales {

struct Disk {
  vec3 center, normal, tangent, bitangent;  ///< Right-handed in this order: tangent, bitangent, normal.
  float radius;
};

/// Returns the area of the polygon that a lattice of nu x nv makes of the unit disk.
double latticeDiskArea(int nu, int nv);

/// Evaluates the disk over the unit square, without a seam; derivatives are parallel only at the four corners.
void evaluateDisk(const Disk& disk, int n, const float* u, const float* v, const SurfacePoints& out);

/// Does the same at the four corners, after moving them away from the centre by the share `more` of their distance.
void evaluateDot(const Disk& disk, float more, const SurfacePoints& out);

}  // namespace tomales

// Private to Blobby: a coarse mesh around the level set of a field, and the search for the surface from that mesh.
#pragma once
#include <array>
#include <optional>

#include "reyes/prim/blobby_field.h"

namespace tomales {

/// A vertex on the surface, or near it. From a point of a quadrilateral, the surface is searched along the blend of its
/// corners' directions, up to the blend of their reaches. So two quadrilaterals agree on their common points.
struct BlobVertex {
  vec3 position, outward;
  float reach;
};

/// Corners (0,0), (1,0), (0,1), (1,1) with dPdu x dPdv outward; where cells of two sizes meet, two corners may be one
/// vertex.
struct BlobQuad {
  std::array<uint32_t, 4> corners;
};

struct BlobMesh {
  std::vector<BlobVertex> vertices;
  std::vector<BlobQuad> quads;
  bool complete = true;  ///< False if the surface was so large that the mesh is coarser than the field requires.
};

/// Dual contouring (Ju et al. 2002) of an octree that is as fine as the field's features, and finer where a cell meets
/// more than one surface or a crease. The mesh is closed. Details smaller than a third of the smallest leaf there may
/// be missed.
BlobMesh contour(const BlobField& field, const Box& box);

/// Returns the same quadrilaterals around `moved`, which is `field` with its leaves moved.
BlobMesh carriedMesh(const BlobMesh& mesh, const BlobField& field, const BlobField& moved);

/// Returns the t where p + t * outward meets the surface, or nothing if it finds none. It searches up to `reach` from
/// p, on the side that the field at p tells, in four steps, and misses a surface that one step crosses twice.
std::optional<double> meetSurface(const BlobField& field, const dvec3& p, const dvec3& outward, double reach);

}  // namespace tomales

// A coarse mesh around the level set of a field, and the way from it to the surface. Private to Blobby.
#pragma once
#include <array>
#include <optional>

#include "reyes/prim/blobby_field.h"

namespace tomales {

/// On the surface, or near it. From all points of a quadrilateral the surface is sought along the blend of its corners'
/// directions, not farther than the blend of their reaches: what two quadrilaterals share depends on what they share.
struct BlobVertex {
  vec3 position, outward;
  float reach;
};

/// Corners (0,0), (1,0), (0,1), (1,1) with dPdu x dPdv outward; where cells of two sizes meet, two may be one vertex.
struct BlobQuad {
  std::array<uint32_t, 4> corners;
};

struct BlobMesh {
  std::vector<BlobVertex> vertices;
  std::vector<BlobQuad> quads;
  bool complete = true;  ///< False: it was so large that it was left coarser than the field asks for.
};

/// Dual contouring (Ju et al. 2002) of an octree that is as fine as the field's features, and finer where a cell meets
/// more than one sheet or a crease. Closed. Details smaller than a third of the least leaf there may be missed.
BlobMesh contour(const BlobField& field, const Box& box);

/// The same quadrilaterals around another field, whose leaves are those of `field` moved.
BlobMesh carriedMesh(const BlobMesh& mesh, const BlobField& field, const BlobField& moved);

/// The t nearest to 0 in [-reach, reach] where p + t * outward meets the surface, if there is one.
std::optional<double> meetSurface(const BlobField& field, const dvec3& p, const dvec3& outward, double reach);

}  // namespace tomales

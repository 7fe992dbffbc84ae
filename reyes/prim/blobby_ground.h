// Private to Blobby: the ground that repels a Blobby (leaf 1003): heights above a depth picture, and the repelling
// field.
#pragma once
#include "reyes/prim/blobby_field.h"
#include "reyes/prim_factories.h"

namespace tomales {

/// The field of PRMan's application note 31. Let z be the distance by which a point is nearer to the picture's camera
/// than the ground. The field is (bulge b(z / bulgeHeight) - sharpness / z) (1 - e(z / height)) for z below `height`,
/// and 0 above it and where the picture shows nothing. b rises from 0 to 1 at 1 and falls to 0 at 2; e eases from 0 to
/// 1.
struct Repulsion {
  double height, sharpness, bulgeHeight, bulge;  ///< A, B, C, D of the note.
  FieldPoint at(double z) const;                 ///< `gradient.x`: d/dz.
  FieldRange over(double lo, double hi) const;
};

class BlobGround {
 public:
  BlobGround(GroundPicture picture, const Repulsion& repulsion);
  FieldPoint at(const dvec3& p) const;
  FieldRange over(const Box& box) const;
  /// Returns the least distance over which the bulge rises or the field falls off.
  double feature() const;

 private:
  /// Range of depths in each block of texels. The blocks of a level are twice as wide as those of the level before.
  struct Level {
    int columns, rows;
    std::vector<float> least, greatest;
  };
  FieldRange depthsOver(double x0, double x1, double y0, double y1) const;

  const Repulsion repulsion_;
  const glm::dmat4 cameraFromObject_, texelFromObject_;
  std::vector<Level> levels_;  ///< The first level has single texels.
};

}  // namespace tomales

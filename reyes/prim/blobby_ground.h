// Private to Blobby: the ground that repels a Blobby (leaf 1003): heights over a depth picture, and the repelling
// field.
#pragma once
#include "reyes/prim.h"
#include "reyes/prim/blobby_field.h"

namespace tomales {

/// The field of PRMan's application note 31. z is how much nearer to the picture's camera a point is than the ground:
/// (bulge b(z / bulgeHeight) - sharpness / z) (1 - e(z / height)) below `height`, 0 above and where the picture shows
/// nothing. b rises from 0 to 1 at 1 and falls to 0 at 2; e eases from 0 to 1.
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
  /// Range of depths of blocks of texels; each level's blocks are twice as wide.
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

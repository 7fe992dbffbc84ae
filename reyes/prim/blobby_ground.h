// The ground that keeps a Blobby away: heights over a picture of depth, and the field that repels (leaf 1003). Private
// to Blobby.
#pragma once
#include "reyes/prim.h"
#include "reyes/prim/blobby_field.h"

namespace tomales {

/// As PRMan's application note 31 has it, z being how much nearer than the ground a point is to the picture's camera:
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
  /// Least distance over which the bulge rises, or all eases off.
  double feature() const;

 private:
  /// The least and the greatest depth of blocks of texels, each level of blocks twice as wide.
  struct Level {
    int columns, rows;
    std::vector<float> least, greatest;
  };
  FieldRange depthsOver(double x0, double x1, double y0, double y1) const;

  const Repulsion repulsion_;
  const glm::dmat4 cameraFromObject_, texelFromObject_;
  std::vector<Level> levels_;  ///< The first: texels.
};

}  // namespace tomales

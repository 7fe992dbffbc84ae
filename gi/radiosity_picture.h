// Verb: radiosity maps -> pictures of radiance, to look at and for shaders. Charts are packed so that each lies at a
// multiple of its own width and height: down to the level of a chart's shorter edge, no texel of the picture's MIP map
// mixes two patches.
#pragma once
#include "gi/radiosity/maps.h"
#include "reyes/image.h"

namespace tomales {

/// The placement of charts in a picture: their lower corners in texels.
struct ChartLayout {
  int width = 0, height = 0;  ///< Powers of two.
  std::vector<glm::ivec2> corner;
};
ChartLayout layOutPicture(const std::vector<RadiosityChart>& charts);
Image pictureOf(const std::vector<RadiosityChart>& charts);

}  // namespace tomales

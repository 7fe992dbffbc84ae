// Private to reyes/image: deep pixels.
#pragma once
#include "reyes/image/weights.h"

namespace tomales {

/// Samples of R G B A Z ZBack (AR AG AB Z ZBack) of every pixel of rows of the crop window. Flattened by "over" they are the
/// filtered pixel; before any depth the opacity is right but for what merging moved: by `depth` of its distance, or by
/// at most `opacity`. A filter with negative lobes is replaced by a box of one pixel: light left behind cannot grow.
DeepRows deepRows(const DeepFrame& frame, const Options& options, const SampleOffsets& samples, const DeepMerge& merge, int y0,
                  int y1);

}  // namespace tomales

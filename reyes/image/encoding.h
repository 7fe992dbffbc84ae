// Private to reyes/image: converts pixels to the numbers of a file.
#pragma once
#include <vector>

#include "reyes/image.h"

namespace tomales {

float exposed(float value, float gain, float gamma);
void divideByAlpha(Image& image);
/// Encodes all channels but alpha as sRGB.
void encodeForScreen(Image& image);
/// Converts each channel to integers from 0 to `limit`, by its quantizer.
void quantise(Image& image, const std::vector<Quantize>& quantizers, float limit);

}  // namespace tomales

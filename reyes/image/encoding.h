// Private to image: how pixels become the numbers of a file.
#pragma once
#include <vector>

#include "reyes/image.h"

namespace tomales {

float exposed(float value, float gain, float gamma);
void divideByAlpha(Image& image);
/// Encodes all channels but alpha as sRGB.
void encodeForScreen(Image& image);
/// Makes integers from 0 to `limit` of each channel as its quantizer says.
void quantise(Image& image, const std::vector<Quantize>& quantizers, float limit);

}  // namespace tomales

// A picture of a frame before it is shaded: of the nearest point in one pixel of every square.
#pragma once
#include "reyes/frame.h"

namespace tomales {

/// Squares of `stride` pixels, R G B A of the crop window, exposed and through the imager, each in the colour of its
/// corner's first point. Shades nothing else, so that all strides of the gather pass together cost a third of shading.
/// Cancelled: what is missing is black.
Image sketch(const DeepFrame& layout, const TileReader& tiles, int stride, const Scene& scene,
             const ShadingSystem& shading, const ShadeContext& context, const std::atomic<bool>& cancelled);

}  // namespace tomales

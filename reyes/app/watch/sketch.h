// A coarse picture of a frame before it is shaded, from the nearest point in one pixel of every square.
#pragma once
#include "reyes/frame.h"

namespace tomales {

/// Returns squares of `stride` pixels, R G B A of the crop window, exposed and through the imager, each in the colour
/// of its corner's first point. It shades nothing else, so that all strides of the gather pass together cost a third of
/// shading. If it is cancelled, the missing squares are black.
Image sketch(const DeepFrame& layout, const TileReader& tiles, int stride, const Scene& scene,
             const ShadingSystem& shading, const ShadeContext& context, const std::atomic<bool>& cancelled);

}  // namespace tomales

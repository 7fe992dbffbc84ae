// Composer: the order of the Reyes stages. Each function is a pass that reads one noun and leaves the next.
//   hideFrame    Scene -> DeepFrame     split, dice, displace, hide, bucket by bucket
//   shadeFrame   DeepFrame -> DeepFrame surface and light shaders over visible points
//   imageOf      DeepFrame -> Image     filter
//   runImager    Image -> Image         imager shader; after exposure (RISpec imaging pipeline)
//   writeFrame   DeepFrame -> files     the last three and every Display, a band of rows at a time
#pragma once
#include <atomic>
#include <functional>

#include "reyes/deep.h"
#include "reyes/image.h"
#include "reyes/shade.h"

namespace tomales {

/// Told after every finished bucket: fraction of this pass, 0..1. May be called from any thread.
using Progress = std::function<void(float fraction)>;

struct FrameControl {
  Progress progress;
  const std::atomic<bool>* cancelled = nullptr;  ///< Set from a signal handler: finish running buckets and return.
  uint32_t seed = 0;
};

DeepFrame hideFrame(const Scene& scene, const ShadingSystem& shading, const FrameControl& control, Stats& stats, Log& log);
void shadeFrame(DeepFrame& frame, const Scene& scene, const ShadingSystem& shading, const ShadeContext& context,
                const FrameControl& control, Stats& stats);
Image imageOf(const DeepFrame& frame, const Scene& scene, const FrameControl& control, Stats& stats);
void runImager(Image& image, const ShadingSystem& shading);
/// What cannot be written is reported; the other Displays are written all the same.
void writeFrame(const DeepFrame& frame, const Scene& scene, const ShadingSystem& shading, const FrameControl& control, Log& log);

}  // namespace tomales

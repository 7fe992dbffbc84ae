// Frames whose layers and sample positions are made by hand.
#pragma once
#include "reyes/base/rng.h"
#include "reyes/image.h"

namespace tomales {

/// A frame of one tile whose layers each cover the samples of a mask in every pixel.
struct Layer {
  vec3 color, opacity;
  float z;
  uint64_t samples;
  bool matte = false;
};

inline DeepFrame frameOf(const std::vector<Layer>& layers, int size, int margin, int samples) {
  DeepFrame frame;
  frame.crop = {0, 0, size, size};
  frame.padded = {-margin, -margin, size + margin, size + margin};
  frame.bucketWidth = frame.bucketHeight = size + 2 * margin;
  frame.columns = frame.rows = 1;
  frame.samplesPerPixel = samples;
  DeepTile tile;
  tile.rect = frame.padded;
  const int count = static_cast<int>(layers.size());
  tile.batches.emplace_back(0, 0);
  tile.shaded.resize(1);
  tile.shaded[0].resize(count);
  for (int i = 0; i < count; ++i) {
    const Layer& layer = layers[static_cast<size_t>(i)];
    tile.batches[0].add(0);
    tile.facets.push_back({0, {i, i, i, i}, layer.matte});
    for (int c = 0; c < 3; ++c) {
      tile.shaded[0].Ci[c][static_cast<size_t>(i)] = layer.color[c];
      tile.shaded[0].Oi[c][static_cast<size_t>(i)] = layer.opacity[c];
    }
  }
  for (int p = 0; p < tile.rect.width() * tile.rect.height(); ++p) {
    tile.pixels.push_back({static_cast<uint32_t>(tile.fragments.size()), static_cast<uint32_t>(count)});
    for (int i = 0; i < count; ++i)
      tile.fragments.push_back(
          {static_cast<uint32_t>(i), layers[static_cast<size_t>(i)].z, layers[static_cast<size_t>(i)].samples});
  }
  frame.tiles.push_back(std::move(tile));
  return frame;
}

inline SampleOffsets jittered(int samples, int patterns) {
  SampleOffsets out;
  out.count = samples;
  for (int p = 0; p < patterns; ++p) {
    out.byPattern.emplace_back();
    for (int s = 0; s < samples; ++s)
      out.byPattern.back().push_back(sobol2(static_cast<uint32_t>(s), static_cast<uint32_t>(p)));
  }
  out.patternOf = [patterns](int x, int y) { return ((x * 7 + y * 13) % patterns + patterns) % patterns; };
  return out;
}

inline Options filtered(const std::string& name, float width) {
  Options options;
  options.filter = name;
  options.xFilterWidth = options.yFilterWidth = width;
  return options;
}

}  // namespace tomales

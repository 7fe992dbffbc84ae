// Makes sample positions from a frame's Options; the hider and the filter must agree on them.
#pragma once
#include "reyes/hide.h"
#include "reyes/image.h"

namespace tomales {

inline SamplePattern samplePattern(const Options& o, uint32_t seed) {
  return SamplePattern(std::max(1, o.xSamples), std::max(1, o.ySamples), o.jitter, seed, o.aperture);
}

inline SampleOffsets sampleOffsets(const SamplePattern& pattern) {
  SampleOffsets out;
  out.count = pattern.count();
  for (int p = 0; p < pattern.patternCount(); ++p) {
    auto& positions = out.byPattern.emplace_back();
    for (int s = 0; s < pattern.count(); ++s) positions.emplace_back(pattern.x(p)[s], pattern.y(p)[s]);
  }
  out.patternOf = [&pattern](int x, int y) { return pattern.patternOf(x, y); };
  return out;
}

}  // namespace tomales

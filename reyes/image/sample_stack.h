// Private to reyes/image: all samples of a pixel while its fragments are composited, front to back.
#pragma once
#include <span>

#include "reyes/base/simd.h"
#include "reyes/output.h"

namespace tomales {

/// The floats R G B A, with which a contribution begins.
constexpr size_t kColorFloats = 4;
/// One float of a contribution beyond these.
struct ExtraFloat {
  int channel, component;  ///< Index in FrameOutput::channels, and component there.
  int variable;            ///< Index in ShadedPoints::variables.
  bool composited;
  float fill;
};

/// ShadedPoints::airCi and airOi of a fragment.
struct Air {
  vec3 color{0.0f}, opacity{0.0f};
};

/// The shade of a fragment: coverage is its opacity, or 0 where it is matte.
struct FacetShade {
  vec3 color, opacity, coverage;
};

/// A layer: a shade over some samples.
struct ShadedLayer {
  const FacetShade* shade;
  uint64_t samples;
  float z;
  uint16_t word;
};
/// The other values of a layer.
struct LayerExtras {
  std::span<const ExtraFloat> extras;
  const float* extraValues;
  const Air* air = nullptr;  ///< Air that is left out of the shade; null if no fragment of the tile has any.
};

/// Arrays have a lane for each sample.
struct SampleStack {
  AlignedVector<float> clear[3];  ///< Share of light that passes all layers so far.
  AlignedVector<float> nearest;   ///< Depth of the nearest layer.
  AlignedVector<float> values;    ///< An array of lanes for each float of a contribution.
  AlignedVector<float> air[4];    ///< R G B A of the last layer's air, dimmed by layers in front; empty without air.
  size_t lanes = 0;
  vec3 hidden;  ///< Further layers are hidden at a sample that lets no more light through than this.

  /// Prepares for compositeAll(), which fills it. samples: a multiple of kLanes.
  void resize(size_t samples, size_t floats);
  /// Prepares for composite().
  void reset(size_t samples, size_t floats, bool withAir);
  /// Composites a layer by "over", with an opacity for each channel.
  void composite(const ShadedLayer& l, const LayerExtras& more);
  /// Composites all layers of a pixel at once, if no other values are needed. It does not set `values` and `nearest`.
  void compositeAll(std::span<const ShadedLayer> shadedLayers);
  /// Adds `air` to `values`. Call it after the last layer, whose air includes the air of all layers in front.
  void addAir();
};

}  // namespace tomales

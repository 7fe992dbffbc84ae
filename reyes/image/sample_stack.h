// Private to reyes/image: all samples of a pixel while its fragments are laid over one another, front to back.
#pragma once
#include <span>

#include "reyes/base/simd.h"
#include "reyes/output.h"

namespace tomales {

/// One float of a contribution beyond R G B A.
struct ExtraFloat {
  int channel, component;  ///< In FrameOutput::channels.
  int variable;            ///< In ShadedPoints::variables.
  bool composited;
  float fill;
};

/// ShadedPoints::airCi and airOi of a fragment.
struct Air {
  vec3 color{0.0f}, opacity{0.0f};
};

/// What a fragment shows: coverage is its opacity, or 0 where it is matte.
struct FacetShade {
  vec3 color, opacity, coverage;
};

/// To some samples.
struct Lay {
  const FacetShade* shade;
  uint64_t samples;
  float z;
  uint16_t word;
};
/// What else it shows.
struct LayMore {
  std::span<const ExtraFloat> extras;
  const float* extraValues;
  const Air* air = nullptr;  ///< Left out of the shade. Null: there is none in all of the tile.
};

/// Arrays have a lane for each sample.
struct SampleStack {
  AlignedVector<float> clear[3];  ///< Share of light that passes what was laid so far.
  AlignedVector<float> nearest;   ///< Depth.
  AlignedVector<float> values;    ///< An array of lanes for each float of a contribution.
  AlignedVector<float>
      air[4];  ///< R G B A of the air before what was laid last, beside it; empty where no tile has any.
  size_t lanes = 0;
  vec3 hidden;  ///< A sample that lets no more light through sees nothing of what follows.

  /// samples: a multiple of kLanes. For layAll(), which fills it.
  void resize(size_t samples, size_t floats);
  /// For lay().
  void reset(size_t samples, size_t floats, bool withAir);
  /// "Over", with an opacity for each channel.
  void lay(const Lay& l, const LayMore& more);
  /// Instead, all of a pixel that has nothing else to show. Leaves `values` and `nearest`.
  void layAll(std::span<const Lay> lays);
  /// After the last: nothing follows that would bring its air.
  void addAir();
};

}  // namespace tomales

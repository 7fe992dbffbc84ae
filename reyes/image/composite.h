// Private to reyes/image: what the samples of a pixel see. Fragments of one pixel -> contributions, each the final
// value of some samples, so that a pixel is composited once and not once for every neighbour whose filter touches it.
#pragma once
#include "reyes/deep.h"
#include "reyes/image/sample_stack.h"

namespace tomales {

struct Contribution {
  uint64_t samples;
  uint16_t word;
  float nearest;              ///< Depth of what it sees first.
  float z = kInfinity;        ///< Of the first surface that is opaque enough to have depth (Options::depthThreshold),
  float zSecond = kInfinity;  ///< and of the second.
};

/// Contributions of the pixels of a tile; those of pixel i are [first[i], first[i + 1]).
struct ResolvedTile {
  std::vector<Contribution> contributions;
  UnsetVector<float> values;  ///< Compositor::width() each: R G B A, then the extra floats. Behind the last, room to
                              ///< read kMargin more.
  static constexpr size_t kMargin = 4;
  std::vector<uint32_t> first;
};

/// Keeps scratch memory; one a thread.
class Compositor {
 public:
  Compositor(const FrameOutput& output, const Options& options, int samples);

  int width() const { return 4 + static_cast<int>(extras_.size()); }
  const std::vector<ExtraFloat>& extras() const { return extras_; }

  ResolvedTile resolve(const DeepTile& tile);

  /// Front to back, for what is not hidden: visit(fragment, shade, samples, clear), with the share of light that passes
  /// what lies before these samples of it. Then, once more, the air that is seen beside the last of each sample.
  template <class Visit>
  void layers(const DeepTile& tile, const DeepPixel& pixel, const Visit& visit);

 private:
  /// What a facet of one point shows, to all fragments alike; nothing of others.
  struct KnownShade {
    FacetShade shade;
    bool known = false;
    bool deep = false;  ///< hasDepth
  };
  void shadeFacets(const DeepTile& tile);
  /// After shadeFacets(). Good until the next tile, or where it is blended until as many as `blended_` has room for
  /// follow.
  const KnownShade& shadeOf(const DeepTile& tile, const Fragment& fragment) {
    const KnownShade& known = shades_[fragment.facet];
    return known.known ? known : blended(tile, fragment);
  }
  const KnownShade& blended(const DeepTile& tile, const Fragment& fragment);
  /// What `shade` has of air, which is taken off it: that of all but the last thing that a sample sees.
  static Air takeAir(const DeepTile& tile, const Fragment& fragment, FacetShade& shade);
  bool disjoint(const Fragment* begin, const Fragment* end);
  bool hasDepth(const FacetShade& shade) const;
  void extraValues(const DeepTile& tile, const Fragment& fragment, float* out) const;
  float* room(size_t contributions, ResolvedTile& out) const;
  void resolveEach(const DeepTile& tile, const Fragment* begin, const Fragment* end, ResolvedTile& out);
  void resolveStack(const DeepTile& tile, const Fragment* begin, const Fragment* end, ResolvedTile& out);
  void noteDepth(const DeepTile& tile, const Fragment& fragment);

  const Options& options_;
  std::vector<ExtraFloat> extras_;
  std::vector<KnownShade> shades_;   ///< Of all facets of a tile.
  std::vector<KnownShade> blended_;  ///< Of fragments of a pixel whose facets have several points.
  std::vector<uint64_t> seen_;       ///< Samples that any fragment covers.
  /// What a sample saw last while layers() runs, and through what.
  struct Last {
    const Fragment* fragment = nullptr;
    vec3 clear;
  };
  std::vector<vec3> clear_;            ///< Of every sample, while layers() runs,
  std::vector<Last> last_;             ///< and in air.
  std::vector<Contribution> samples_;  ///< Of every sample, while a stack is resolved,
  std::vector<int> batchOf_;           ///< where their z is from,
  SampleStack stack_;                  ///< and what they see.
  std::vector<Lay> lays_;
  std::vector<float> facetValues_;
};

FacetShade facetShade(const DeepTile& tile, const Fragment& fragment);
bool hasAir(const DeepTile& tile);

inline int lowestBit(uint64_t mask) { return __builtin_ctzll(mask); }
inline float meanOf(const vec3& v) { return (v.x + v.y + v.z) / 3; }

template <class Visit>
void Compositor::layers(const DeepTile& tile, const DeepPixel& pixel, const Visit& visit) {
  const Fragment* begin = tile.fragments.data() + pixel.first;
  const Fragment* end = begin + pixel.count;
  if (disjoint(begin, end)) {
    for (const Fragment* f = begin; f != end; ++f) visit(*f, facetShade(tile, *f), f->samples, vec3(1.0f));
    return;
  }
  std::fill(clear_.begin(), clear_.end(), vec3(1.0f));
  const bool air = hasAir(tile);
  if (air) last_.assign(clear_.size(), {});
  const vec3 hidden = vec3(1.0f) - options_.opaqueThreshold;
  for (const Fragment* f = begin; f != end; ++f) {
    FacetShade shade = facetShade(tile, *f);
    if (air) takeAir(tile, *f, shade);
    for (uint64_t left = f->samples; left; left &= left - 1) {
      const size_t sample = static_cast<size_t>(f->word) * 64 + static_cast<size_t>(lowestBit(left));
      vec3& clear = clear_[sample];
      if (clear.x <= hidden.x && clear.y <= hidden.y && clear.z <= hidden.z) continue;
      visit(*f, shade, left & (~left + 1), clear);
      if (air) last_[sample] = {f, clear};
      clear *= vec3(1.0f) - shade.opacity;
    }
  }
  for (size_t sample = 0; air && sample < last_.size(); ++sample) {
    const Last& last = last_[sample];
    if (!last.fragment) continue;
    FacetShade shade{vec3(0.0f), vec3(0.0f), vec3(0.0f)};
    const Air seen = takeAir(tile, *last.fragment, shade);
    visit(*last.fragment, {seen.color, seen.opacity, seen.opacity}, uint64_t{1} << (sample % 64), last.clear);
  }
}

}  // namespace tomales

// Private to reyes/image: turns the fragments of a pixel into contributions. A contribution is the final value of some
// samples. So a pixel is composited once, and not once for every neighbour whose filter reaches it.
#pragma once
#include "reyes/deep.h"
#include "reyes/image/sample_stack.h"

namespace tomales {

struct Contribution {
  uint64_t samples;
  uint16_t word;
  float nearest;        ///< Depth of the nearest surface.
  float z = kInfinity;  ///< Depth of the first surface that is opaque enough to have depth (Options::depthThreshold).
  float zSecond = kInfinity;  ///< Depth of the second such surface.
};

/// Contributions of the pixels of a tile; those of pixel i are [first[i], first[i + 1]).
struct ResolvedTile {
  std::vector<Contribution> contributions;
  /// Compositor::width() floats for each contribution: R G B A, then the extra floats. kMargin more floats after the
  /// last may be read.
  UnsetVector<float> values;
  static constexpr size_t kMargin = 4;
  std::vector<uint32_t> first;
};

/// Keeps scratch memory; each thread has its own.
class Compositor {
 public:
  Compositor(const FrameOutput& output, const Options& options, int samples);

  int width() const { return static_cast<int>(kColorFloats + extras_.size()); }
  const std::vector<ExtraFloat>& extras() const { return extras_; }

  ResolvedTile resolve(const DeepTile& tile);

  /// Goes over the visible fragments front to back and calls visit(fragment, shade, samples, clear). `clear` is the
  /// share of light that passes everything in front of the fragment at these samples. At the end it calls visit for the
  /// air beside the last fragment of each sample.
  template <class Visit>
  void layers(const DeepTile& tile, const DeepPixel& pixel, const Visit& visit);

 private:
  /// The shade of a facet with one point, which is the same for all its fragments; unknown for other facets.
  struct KnownShade {
    FacetShade shade;
    bool known = false;
    bool deep = false;  ///< The result of hasDepth().
  };
  void shadeFacets(const DeepTile& tile);
  /// Pre: shadeFacets(). A blended result is valid until the next pixel, any other until the next tile.
  const KnownShade& shadeOf(const DeepTile& tile, const Fragment& fragment) {
    const KnownShade& known = shades_[fragment.facet];
    return known.known ? known : blended(tile, fragment);
  }
  const KnownShade& blended(const DeepTile& tile, const Fragment& fragment);
  /// Removes and returns the part of `shade` that is air. Only the last surface that a sample sees keeps its air.
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
  std::vector<KnownShade> shades_;   ///< Indexed by facet of a tile.
  std::vector<KnownShade> blended_;  ///< Shades of fragments of a pixel whose facets have several points.
  std::vector<uint64_t> seen_;       ///< Samples that any fragment covers.
  /// The last fragment that a sample has seen while layers() runs, and the light that passed to it.
  struct Last {
    const Fragment* fragment = nullptr;
    vec3 clear;
  };
  std::vector<vec3> clear_;            ///< Indexed by sample, while layers() runs: the light that passes.
  std::vector<Last> last_;             ///< Indexed by sample, while layers() runs with air.
  std::vector<Contribution> samples_;  ///< Indexed by sample, while a stack is resolved.
  std::vector<int> batchOf_;           ///< The batch that gave the z of each sample.
  SampleStack stack_;                  ///< The samples of a pixel while they are composited.
  std::vector<ShadedLayer> shadedLayers_;
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

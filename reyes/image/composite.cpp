#include "reyes/image/composite.h"

#include <bit>

namespace tomales {
namespace {

bool isConstant(const Facet& f) { return f.point[1] == f.point[0] && f.point[2] == f.point[0]; }

/// Points of a facet and their weights: the first alone, or the four corners at a fragment.
struct Blend {
  size_t count = 1;
  std::array<float, 4> weight = {1, 0, 0, 0};

  Blend() = default;
  Blend(const Facet& f, const Fragment& fragment) {
    if (isConstant(f)) return;
    count = 4;
    weight = fragment.cornerWeights();
  }
};

FacetShade blendedShade(const DeepTile& tile, const Facet& facet, const Blend& blend) {
  const ShadedPoints& shaded = tile.shaded[static_cast<size_t>(facet.batch)];
  FacetShade out{blend.weight[0] * shaded.color(facet.point[0]), blend.weight[0] * shaded.opacity(facet.point[0]),
                 vec3(0.0f)};
  for (size_t i = 1; i < blend.count; ++i) {
    out.color += blend.weight[i] * shaded.color(facet.point[i]);
    out.opacity += blend.weight[i] * shaded.opacity(facet.point[i]);
  }
  if (facet.matte)
    out.color = vec3(0.0f);
  else
    out.coverage = out.opacity;
  return out;
}

std::vector<ExtraFloat> extrasOf(const FrameOutput& output) {
  std::vector<ExtraFloat> out;
  for (size_t c = 0; c < output.channels.size(); ++c) {
    const Channel& channel = output.channels[c];
    if (channel.kind != ChannelKind::Variable) continue;
    const int first = output.variables[static_cast<size_t>(channel.variable)].first;
    for (int k = 0; k < channel.width(); ++k)
      out.push_back({static_cast<int>(c), k, first + k, channel.composited, channel.fill});
  }
  return out;
}

}  // namespace

FacetShade facetShade(const DeepTile& tile, const Fragment& fragment) {
  const Facet& facet = tile.facets[fragment.facet];
  return blendedShade(tile, facet, Blend(facet, fragment));
}

bool hasAir(const DeepTile& tile) {
  return std::any_of(tile.shaded.begin(), tile.shaded.end(), [](const ShadedPoints& s) { return !s.airCi[0].empty(); });
}

Air Compositor::takeAir(const DeepTile& tile, const Fragment& fragment, FacetShade& shade) {
  const Facet& facet = tile.facets[fragment.facet];
  const ShadedPoints& shaded = tile.shaded[static_cast<size_t>(facet.batch)];
  Air out;
  if (facet.matte || shaded.airCi[0].empty()) return out;
  const Blend blend(facet, fragment);
  for (size_t i = 0; i < blend.count; ++i)
    for (int k = 0; k < 3; ++k) {
      const auto point = static_cast<size_t>(facet.point[i]);
      out.color[k] += blend.weight[i] * shaded.airCi[k][point];
      out.opacity[k] += blend.weight[i] * shaded.airOi[k][point];
    }
  shade.color -= out.color;
  shade.opacity -= out.opacity;
  shade.coverage -= out.opacity;
  return out;
}

Compositor::Compositor(const FrameOutput& output, const Options& options, int samples)
    : options_(options),
      extras_(extrasOf(output)),
      seen_(static_cast<size_t>(samples + 63) / 64),
      clear_(static_cast<size_t>(padded(samples))),
      samples_(clear_.size()),
      batchOf_(clear_.size()),
      facetValues_(extras_.size()) {}

bool Compositor::disjoint(const Fragment* begin, const Fragment* end) {
  std::fill(seen_.begin(), seen_.end(), 0);
  bool overlap = false;
  for (const Fragment* f = begin; f != end; ++f) {
    overlap |= (seen_[f->word] & f->samples) != 0;
    seen_[f->word] |= f->samples;
  }
  return !overlap;
}

bool Compositor::hasDepth(const FacetShade& shade) const {
  const vec3 &o = shade.opacity, &least = options_.depthThreshold;
  return o.x >= least.x && o.y >= least.y && o.z >= least.z;
}

void Compositor::extraValues(const DeepTile& tile, const Fragment& fragment, float* out) const {
  const Facet& facet = tile.facets[fragment.facet];
  const ShadedPoints& shaded = tile.shaded[static_cast<size_t>(facet.batch)];
  const Blend blend(facet, fragment);
  for (size_t e = 0; e < extras_.size(); ++e) {
    const ExtraFloat& extra = extras_[e];
    out[e] = facet.matte && !extra.composited ? extra.fill : 0;
    if (facet.matte) continue;
    const AlignedVector<float>& values = shaded.variables[static_cast<size_t>(extra.variable)];
    for (size_t i = 0; i < blend.count; ++i) out[e] += blend.weight[i] * values[static_cast<size_t>(facet.point[i])];
  }
}

void Compositor::shadeFacets(const DeepTile& tile) {
  shades_.resize(tile.facets.size());
  for (size_t i = 0; i < shades_.size(); ++i) {
    KnownShade& s = shades_[i];
    const Facet& facet = tile.facets[i];
    s.known = isConstant(facet);
    if (s.known) {
      s.shade = blendedShade(tile, facet, Blend());
      s.deep = hasDepth(s.shade);
    }
  }
}

const Compositor::KnownShade& Compositor::blended(const DeepTile& tile, const Fragment& fragment) {
  const FacetShade shade = facetShade(tile, fragment);
  return blended_.emplace_back(KnownShade{shade, true, hasDepth(shade)});
}

ResolvedTile Compositor::resolve(const DeepTile& tile) {
  shadeFacets(tile);
  ResolvedTile out;
  out.first.reserve(tile.pixels.size() + 1);
  out.contributions.reserve(tile.fragments.size());
  out.values.reserve(tile.fragments.size() * static_cast<size_t>(width()) + ResolvedTile::kMargin);
  for (const DeepPixel& pixel : tile.pixels) {
    out.first.push_back(static_cast<uint32_t>(out.contributions.size()));
    const Fragment* begin = tile.fragments.data() + pixel.first;
    const Fragment* end = begin + pixel.count;
    if (begin == end) continue;
    blended_.clear();
    blended_.reserve(pixel.count);
    if (end - begin == 1 || disjoint(begin, end))
      resolveEach(tile, begin, end, out);
    else
      resolveStack(tile, begin, end, out);
  }
  out.first.push_back(static_cast<uint32_t>(out.contributions.size()));
  out.values.resize(out.values.size() + ResolvedTile::kMargin);
  return out;
}

/// Makes room for the values of further contributions, and returns the address of the first.
float* Compositor::room(size_t contributions, ResolvedTile& out) const {
  const size_t at = out.values.size();
  out.values.resize(at + contributions * static_cast<size_t>(width()));
  return out.values.data() + at;
}

void Compositor::resolveEach(const DeepTile& tile, const Fragment* begin, const Fragment* end, ResolvedTile& out) {
  float* value = room(static_cast<size_t>(end - begin), out);
  for (const Fragment* f = begin; f != end; ++f, value += width()) {
    const auto& [s, known, deep] = shadeOf(tile, *f);
    out.contributions.push_back({f->samples, f->word, f->z, deep ? f->z : kInfinity});
    value[0] = s.color.x;
    value[1] = s.color.y;
    value[2] = s.color.z;
    value[3] = meanOf(s.coverage);
    if (!extras_.empty()) extraValues(tile, *f, value + kColorFloats);
  }
}

/// Notes the depths of a fragment; Options::depthFilter may need the second surface, behind an opaque one.
void Compositor::noteDepth(const DeepTile& tile, const Fragment& f) {
  const Facet& facet = tile.facets[f.facet];
  // Neighbours on one surface overlap at their border (docs/decisions/0003), which does not count as a second surface.
  const float overlap = tile.edgeOf(facet);
  for (uint64_t left = f.samples; left; left &= left - 1) {
    const size_t sample = size_t{f.word} * 64 + static_cast<size_t>(lowestBit(left));
    Contribution& s = samples_[sample];
    if (s.z == kInfinity) {
      s.z = f.z;
      batchOf_[sample] = facet.batch;
    } else if (facet.batch != batchOf_[sample] || f.z > s.z + overlap)
      s.zSecond = std::min(s.zSecond, f.z);
  }
}

void Compositor::resolveStack(const DeepTile& tile, const Fragment* begin, const Fragment* end, ResolvedTile& out) {
  for (Contribution& s : samples_) s = {0, 0, kInfinity};
  const bool withAir = hasAir(tile);
  stack_.hidden = vec3(1.0f) - options_.opaqueThreshold;
  const bool atOnce = extras_.empty() && !withAir;
  if (atOnce)
    stack_.resize(samples_.size(), static_cast<size_t>(width()));
  else
    stack_.reset(samples_.size(), static_cast<size_t>(width()), withAir);
  shadedLayers_.clear();
  for (const Fragment* f = begin; f != end; ++f) {
    const KnownShade& known = shadeOf(tile, *f);
    if (known.deep) noteDepth(tile, *f);
    if (atOnce) {
      shadedLayers_.push_back({&known.shade, f->samples, f->z, f->word});
      continue;
    }
    FacetShade shade = known.shade;
    const Air air = withAir ? takeAir(tile, *f, shade) : Air{};
    extraValues(tile, *f, facetValues_.data());
    stack_.composite({&shade, f->samples, f->z, f->word}, {extras_, facetValues_.data(), withAir ? &air : nullptr});
  }
  if (atOnce)
    stack_.compositeAll(shadedLayers_);
  else
    stack_.addAir();
  size_t seeing = 0;
  for (const uint64_t word : seen_) seeing += static_cast<size_t>(std::popcount(word));
  float* value = room(seeing, out);
  for (size_t word = 0; word < seen_.size(); ++word)
    for (uint64_t left = seen_[word]; left; left &= left - 1, value += width()) {
      const size_t sample = word * 64 + static_cast<size_t>(lowestBit(left));
      Contribution& s = samples_[sample];
      s.samples = left & (~left + 1);
      s.word = static_cast<uint16_t>(word);
      s.nearest = stack_.nearest[sample];
      out.contributions.push_back(s);
      for (size_t k = 0; k < static_cast<size_t>(width()); ++k) value[k] = stack_.values[k * stack_.lanes + sample];
    }
}

}  // namespace tomales

#include "reyes/image/composite.h"

namespace tomales {
namespace {

/// The points of a facet and their weights at a fragment: one, or the four corners.
struct Blend {
  const Facet& facet;
  int count = 1;
  float weight[4] = {1, 0, 0, 0};

  Blend(const Facet& f, const Fragment& fragment) : facet(f) {
    if (f.point[1] == f.point[0] && f.point[2] == f.point[0]) return;
    const float u = static_cast<float>(fragment.u) / 255, v = static_cast<float>(fragment.v) / 255;
    count = 4;
    weight[0] = (1 - u) * (1 - v), weight[1] = u * (1 - v), weight[2] = (1 - u) * v, weight[3] = u * v;
  }
};

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
  const ShadedPoints& shaded = tile.shaded[static_cast<size_t>(facet.batch)];
  const Blend blend(facet, fragment);
  FacetShade out{blend.weight[0] * shaded.color(facet.point[0]), blend.weight[0] * shaded.opacity(facet.point[0]), vec3(0.0f)};
  for (int i = 1; i < blend.count; ++i) {
    out.color += blend.weight[i] * shaded.color(facet.point[i]);
    out.opacity += blend.weight[i] * shaded.opacity(facet.point[i]);
  }
  if (facet.matte)
    out.color = vec3(0.0f);
  else
    out.coverage = out.opacity;
  return out;
}

Compositor::Compositor(const FrameOutput& output, const Options& options, int samples)
    : options_(options),
      extras_(extrasOf(output)),
      seen_(static_cast<size_t>(samples + 63) / 64),
      clear_(seen_.size() * 64),
      samples_(clear_.size()),
      batchOf_(clear_.size()),
      sampleValues_(clear_.size() * static_cast<size_t>(width())),
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

void Compositor::shadeAll(const DeepTile& tile, const DeepPixel& pixel) {
  shades_.clear();
  for (uint32_t i = 0; i < pixel.count; ++i) shades_.push_back(facetShade(tile, tile.fragments[pixel.first + i]));
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
    for (int i = 0; i < blend.count; ++i) out[e] += blend.weight[i] * values[static_cast<size_t>(facet.point[i])];
  }
}

void Compositor::resolve(const DeepTile& tile, const DeepPixel& pixel, ResolvedRows& out) {
  const Fragment* begin = tile.fragments.data() + pixel.first;
  const Fragment* end = begin + pixel.count;
  if (disjoint(begin, end))
    resolveEach(tile, begin, end, out);
  else
    resolveStack(tile, pixel, out);
}

void Compositor::resolveEach(const DeepTile& tile, const Fragment* begin, const Fragment* end, ResolvedRows& out) {
  for (const Fragment* f = begin; f != end; ++f) {
    const FacetShade s = facetShade(tile, *f);
    out.contributions.push_back({f->samples, f->word, f->z});
    if (hasDepth(s)) out.contributions.back().z = f->z;
    out.values.insert(out.values.end(), {s.color.x, s.color.y, s.color.z, meanOf(s.coverage)});
    if (extras_.empty()) continue;
    extraValues(tile, *f, facetValues_.data());
    out.values.insert(out.values.end(), facetValues_.begin(), facetValues_.end());
  }
}

// Front to back "over" with an opacity for each channel; depth looks behind what is opaque, for its second surface.
void Compositor::resolveStack(const DeepTile& tile, const DeepPixel& pixel, ResolvedRows& out) {
  const auto stride = static_cast<size_t>(width());
  const auto sampleOf = [](const Fragment& f, uint64_t bit) {
    return static_cast<size_t>(f.word) * 64 + static_cast<size_t>(lowestBit(bit));
  };
  for (Contribution& s : samples_) s = {0, 0, kInfinity};
  std::fill(sampleValues_.begin(), sampleValues_.end(), 0.0f);
  shadeAll(tile, pixel);
  for (uint32_t i = 0; i < pixel.count; ++i) {
    const Fragment& f = tile.fragments[pixel.first + i];
    if (!hasDepth(shades_[i])) continue;
    const Facet& facet = tile.facets[f.facet];
    // Neighbours on one surface reach over each other (docs/decisions/0003) and are no second one.
    const float overlap = tile.edgeOf(facet);
    for (uint64_t left = f.samples; left; left &= left - 1) {
      const size_t sample = sampleOf(f, left);
      Contribution& s = samples_[sample];
      if (s.z == kInfinity)
        s.z = f.z, batchOf_[sample] = facet.batch;
      else if (facet.batch != batchOf_[sample] || f.z > s.z + overlap)
        s.zSecond = std::min(s.zSecond, f.z);
    }
  }
  const Fragment* extrasOfFragment = nullptr;
  walk(tile, pixel, [&](const Fragment& f, const FacetShade& shade, uint64_t bit, const vec3& clear) {
    const size_t sample = sampleOf(f, bit);
    float* value = sampleValues_.data() + sample * stride;
    const bool first = samples_[sample].nearest == kInfinity;
    samples_[sample].nearest = std::min(samples_[sample].nearest, f.z);
    const vec3 color = clear * shade.color;
    value[0] += color.x, value[1] += color.y, value[2] += color.z;
    value[3] += meanOf(clear * shade.coverage);
    if (extras_.empty()) return;
    if (extrasOfFragment != &f) extraValues(tile, f, facetValues_.data()), extrasOfFragment = &f;
    for (size_t e = 0; e < extras_.size(); ++e)
      if (extras_[e].composited)
        value[4 + e] += clear[extras_[e].component % 3] * facetValues_[e];
      else if (first)
        value[4 + e] = facetValues_[e];
  });
  for (size_t word = 0; word < seen_.size(); ++word)
    for (uint64_t left = seen_[word]; left; left &= left - 1) {
      const size_t sample = word * 64 + static_cast<size_t>(lowestBit(left));
      Contribution& s = samples_[sample];
      s.samples = left & (~left + 1), s.word = static_cast<uint16_t>(word);
      out.contributions.push_back(s);
      const float* value = sampleValues_.data() + sample * stride;
      out.values.insert(out.values.end(), value, value + stride);
    }
}

}  // namespace tomales

// Turns the layers of the samples around a pixel into a short list of depths. The layers at one depth are a share of
// the filtered pixel. As in deep shadow maps (Lokovic and Veach 2000), the shares from front to back give the light
// that remains behind each depth.
#include "reyes/image/deep_rows.h"
#include "reyes/base/parallel.h"

namespace tomales {
namespace {

constexpr int kDeepBandRows = 16;
constexpr float kNothingLeft = 1e-5f;

/// The share of a layer in the pixel that is being filtered.
struct Share {
  float z;
  vec3 color, coverage;
};

/// Turns shares into samples, merging shares that are near in depth or too faint to matter.
class Merger {
 public:
  Merger(const DeepMerge& merge, DeepRows& out) : merge_(merge), out_(out) {}

  void pixel(std::vector<Share>& shares) {
    std::stable_sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) { return a.z < b.z; });
    before_ = vec3(0.0f);
    open_ = false;
    count_ = 0;
    for (const Share& s : shares) {
      if (open_ && !joins(s)) close();
      if (!open_) {
        start_ = s.z;
        color_ = coverage_ = vec3(0.0f);
        open_ = true;
      }
      end_ = s.z;
      color_ += s.color;
      coverage_ += s.coverage;
    }
    if (open_) close();
    out_.counts.push_back(count_);
  }

 private:
  bool joins(const Share& s) const {
    if (s.z - start_ <= merge_.depth * std::abs(start_)) return true;
    const float last = 1 - meanOf(before_ + coverage_);
    return meanOf(coverage_ + s.coverage) <= merge_.opacity || last < kNothingLeft;
  }

  // Closes a sample: a share of the pixel is seen through the light that the shares before it leave.
  void close() {
    const auto through = [](float share, float before) { return share / std::max(1 - before, kNothingLeft); };
    const float alphaBefore = meanOf(before_);
    vec3 opacity;
    for (int k = 0; k < 3; ++k) opacity[k] = std::min(through(coverage_[k], before_[k]), 1.0f);
    const float alpha = std::min(through(meanOf(coverage_), alphaBefore), 1.0f);
    if (merge_.opacityOnly)
      out_.values.insert(out_.values.end(), {opacity.x, opacity.y, opacity.z, start_, end_});
    else
      out_.values.insert(out_.values.end(), {through(color_.x, alphaBefore), through(color_.y, alphaBefore),
                                             through(color_.z, alphaBefore), alpha, start_, end_});
    before_ += coverage_;
    open_ = false;
    ++count_;
  }

  const DeepMerge merge_;
  DeepRows& out_;
  vec3 before_{0.0f}, color_{0.0f}, coverage_{0.0f};
  float start_ = 0, end_ = 0;
  bool open_ = false;
  uint32_t count_ = 0;
};

}  // namespace

LayeredRows layersOf(const DeepFrame& frame, const Options& options, int y0, int y1) {
  const PixelRect& padded = frame.padded;
  LayeredRows rows{{padded.x0, std::max(padded.y0, y0), padded.x1, std::min(padded.y1, y1)}, {}, {0}};
  Compositor compositor(FrameOutput{}, options, frame.samplesPerPixel);
  for (int y = rows.rect.y0; y < rows.rect.y1; ++y)
    for (int x = rows.rect.x0; x < rows.rect.x1; ++x) {
      if (const DeepTile* tile = finishedTile(frame, x, y))
        compositor.layers(*tile, tile->pixel(x, y),
                          [&](const Fragment& f, const FacetShade& s, uint64_t samples, const vec3& clear) {
                            if (s.coverage == vec3(0.0f) && s.color == vec3(0.0f)) return;  // a holdout
                            const int group = tile->batches[static_cast<size_t>(tile->facets[f.facet].batch)].group();
                            rows.layers.push_back({samples, f.word, group, f.z, clear * s.color, clear * s.coverage});
                          });
      rows.first.push_back(rows.layers.size());
    }
  return rows;
}

PixelFilter positiveFilter(const Options& options) {
  const PixelFilter asked(options.filter, options.xFilterWidth, options.yFilterWidth);
  return asked.hasNegativeLobes() ? PixelFilter("box", 1, 1) : asked;
}

DeepRows deepRows(const DeepFrame& frame, const Options& options, const SampleOffsets& samples, const DeepMerge& merge,
                  int y0, int y1) {
  const WeightTable weights(positiveFilter(options), samples);
  const int width = frame.crop.width();
  const auto bands = static_cast<size_t>((y1 - y0 + kDeepBandRows - 1) / kDeepBandRows);
  std::vector<DeepRows> parts(bands);
  parallelFor(bands, 1, [&](size_t begin, size_t end) {
    for (size_t band = begin; band < end; ++band) {
      const int first = y0 + static_cast<int>(band) * kDeepBandRows, last = std::min(first + kDeepBandRows, y1);
      const LayeredRows rows = layersOf(frame, options, first - weights.reachY, last + weights.reachY);
      Merger merger(merge, parts[band]);
      std::vector<Share> shares;
      for (int y = first; y < last; ++y)
        for (int x = frame.crop.x0; x < frame.crop.x1; ++x) {
          float total = 0;
          shares.clear();
          forNeighbours(rows.rect, weights, samples, x, y, [&](const WeightTable::Cell& cell, const ivec2& pixel) {
            total += weights.sum(cell);
            for (const Layer& l : rows.at(pixel)) {
              const float w = weights.sum(cell, l.samples, l.word);
              if (w > 0) shares.push_back({l.z, w * l.color, w * l.coverage});
            }
          });
          for (Share& s : shares) {
            s.color /= total;
            s.coverage /= total;
          }
          merger.pixel(shares);
        }
    }
  });
  DeepRows out{frame.crop.x0, y0, width, y1 - y0, {}, {}};
  for (const DeepRows& part : parts) {
    out.counts.insert(out.counts.end(), part.counts.begin(), part.counts.end());
    out.values.insert(out.values.end(), part.values.begin(), part.values.end());
  }
  return out;
}

}  // namespace tomales

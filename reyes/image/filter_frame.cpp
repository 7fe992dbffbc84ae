// Filters contributions to pixels, some rows at a time.
#include "reyes/base/check.h"
#include "reyes/base/parallel.h"
#include "reyes/image.h"
#include "reyes/image/cryptomatte.h"
#include "reyes/image/deep_rows.h"
#include "reyes/image/resolved_frame.h"
#include "reyes/image/weights.h"

namespace tomales {
namespace {

constexpr int kFilterBlockRows = 32,
              kFilterBlockColumns = 128;  ///< Pixels that are filtered at a time, whose contributions are in memory.

/// The floats of a pixel that share a filter.
struct Pass {
  Pass(const Sampling& s, const SampleOffsets& offsets) : weights(PixelFilter(s.filter, s.xWidth, s.yWidth), offsets) {}
  WeightTable weights;
  struct Float {
    size_t from;  ///< Index in a contribution.
    int to;       ///< Index in a pixel.
    float fill;
  };
  std::vector<Float> floats;

  bool anyFill() const {
    return std::any_of(floats.begin(), floats.end(), [](const Float& f) { return f.fill != 0; });
  }
  /// Tells whether the floats are adjacent in contributions, so that they can be used in place.
  bool together() const {
    for (size_t k = 1; k < floats.size(); ++k)
      if (floats[k].from != floats[0].from + k) return false;
    return true;
  }
};

/// A channel that is not filtered but reduced (Reduce).
struct Reduction {
  Reduction(const Sampling& s, const SampleOffsets& offsets)
      : reduce(s.reduce), weights(PixelFilter("box", s.xWidth, s.yWidth), offsets) {}
  Reduce reduce;
  WeightTable weights;
  size_t from = 0;
  int to = 0, width = 1;
  float fill = 0;
};

/// Pixels whose samples reach a block, and the pattern of each.
struct Around {
  PixelRect rect;
  std::vector<int> patterns;

  Around(const PixelRect& block, const WeightTable& w, const PixelRect& frame, const SampleOffsets& samples)
      : rect{std::max(frame.x0, block.x0 - w.reachX), std::max(frame.y0, block.y0 - w.reachY),
             std::min(frame.x1, block.x1 + w.reachX), std::min(frame.y1, block.y1 + w.reachY)} {
    patterns.reserve(static_cast<size_t>(rect.width()) * static_cast<size_t>(rect.height()));
    for (int y = rect.y0; y < rect.y1; ++y)
      for (int x = rect.x0; x < rect.x1; ++x) patterns.push_back(samples.patternOf(x, y));
  }
  /// Patterns of a row, indexed by x.
  const int* row(int y) const { return patterns.data() + static_cast<ptrdiff_t>(y - rect.y0) * rect.width() - rect.x0; }
};

}  // namespace

struct FrameFilter::Impl {
  using Seen = ResolvedFrame::Seen;

  Impl(const DeepFrame& f, const Options& o, const SampleOffsets& s, const MatteNames& n)
      : frame(f), options(o), samples(s), names(n), output(outputOf(o)), resolved(f, output, o) {
    addPass({Reduce::Filter, o.filter, o.xFilterWidth, o.yFilterWidth}).floats = {
        {0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}};
    const std::vector<ExtraFloat>& extras = resolved.extras();
    for (size_t e = 0; e < extras.size(); ++e) {
      const Channel& channel = output.channels[static_cast<size_t>(extras[e].channel)];
      if (channel.sampling.reduce == Reduce::Filter)
        addPass(channel.sampling)
            .floats.push_back({kColorFloats + e, channel.first + extras[e].component, extras[e].fill});
      else if (extras[e].component == 0)
        addReduction(channel, kColorFloats + e);
    }
    const auto reach = [this](const WeightTable& w) {
      reachX = std::max(reachX, w.reachX);
      reachY = std::max(reachY, w.reachY);
    };
    for (const Pass& p : passes) reach(p.weights);
    for (const Reduction& r : reductions) reach(r.weights);
  }

  Pass& addPass(const Sampling& s) {
    for (size_t i = 0; i < passes.size(); ++i)
      if (passSamplings[i] == s) return passes[i];
    passSamplings.push_back(s);
    return passes.emplace_back(s, samples);
  }
  void addReduction(const Channel& channel, size_t from) {
    Reduction& r = reductions.emplace_back(channel.sampling, samples);
    r.from = from;
    r.to = channel.first;
    r.width = channel.width();
    r.fill = channel.fill;
  }

  void filter(const Pass& pass, const PixelRect& block, const std::function<float*(int x, int y)>& at) const {
    const Around around(block, pass.weights, frame.padded, samples);
    const PixelSums sums = sumsOf(pass, block, around);
    const std::vector<float> totals = totalsOf(pass.weights, block, around);
    const bool fills = pass.anyFill();
    const float* total = totals.data();
    for (int y = block.y0; y < block.y1; ++y) {
      float* out = at(block.x0, y);
      for (int x = block.x0; x < block.x1; ++x, ++total, out += output.floatsPerPixel) {
        const float* sum = sums.of(x, y);
        const float uncovered = fills ? *total - sum[pass.floats.size()] : 0;
        for (size_t k = 0; k < pass.floats.size(); ++k) {
          const Pass::Float& f = pass.floats[k];
          const float filled = f.fill == 0 ? sum[k] : sum[k] + f.fill * uncovered;
          out[f.to] = *total != 0 ? filled / *total : f.fill;
        }
      }
    }
  }

  /// Weighted sums of the samples around each pixel of a block: of the floats of a pass, and of the weight of samples
  /// that see something if any float has a fill. The order for each pixel is rows, columns and fragments.
  PixelSums sumsOf(const Pass& pass, const PixelRect& block, const Around& around) const {
    const size_t floats = pass.floats.size(), step = static_cast<size_t>(resolved.width());
    const bool fills = pass.anyFill(), copies = fills || !pass.together();
    PixelSums sums(pass.weights, block, static_cast<int>(floats + fills));
    const auto wide = static_cast<size_t>(sums.width());
    AlignedVector<float> values;
    for (int y = around.rect.y0; y < around.rect.y1; ++y) {
      const int* patterns = around.row(y);
      resolved.forRow(around.rect.x0, around.rect.x1, y, [&](int x, const Seen& here) {
        const size_t count = here.list.size();
        if (count == 0) return;
        if (!copies) return sums.add(x, y, patterns[x], {here.list, here.values + pass.floats[0].from, step});
        if (values.size() < count * wide) values.resize(count * wide);
        for (size_t c = 0; c < count; ++c) {
          float* to = values.data() + c * wide;
          for (size_t k = 0; k < floats; ++k) to[k] = here.values[c * step + pass.floats[k].from];
          if (fills) to[floats] = 1;
        }
        sums.add(x, y, patterns[x], {here.list, values.data(), wide});
      });
    }
    return sums;
  }

  /// Returns the sums of weights of all samples around each pixel of a block, by rows.
  std::vector<float> totalsOf(const WeightTable& w, const PixelRect& block, const Around& around) const {
    const auto columns = static_cast<size_t>(block.width());
    std::vector<float> totals(columns * static_cast<size_t>(block.height()));
    for (int y = block.y0; y < block.y1; ++y) {
      float* total = totals.data() + static_cast<size_t>(y - block.y0) * columns - block.x0;
      for (int sy = std::max(y - w.reachY, around.rect.y0); sy < std::min(y + w.reachY + 1, around.rect.y1); ++sy)
        for (int dx = -w.reachX; dx <= w.reachX; ++dx) {
          const int *patterns = around.row(sy) + dx, place = w.cell(0, dx, sy - y).place;
          const int first = std::max(block.x0, around.rect.x0 - dx), end = std::min(block.x1, around.rect.x1 - dx);
          for (int x = first; x < end; ++x) total[x] += w.sums(patterns[x])[place];
        }
    }
    return totals;
  }

  void reduce(const Reduction& r, int x, int y, float* out) const {
    float weight = 0, best = 0;
    float* to = out + r.to;
    std::fill_n(to, r.width, r.fill);
    forNeighbours(frame.padded, r.weights, samples, x, y, [&](const WeightTable::Cell& cell, const ivec2& pixel) {
      const Seen here = resolved.seenAt(pixel.x, pixel.y);
      for (size_t i = 0; i < here.list.size(); ++i) {
        const Contribution& c = here.list[i];
        const float w = r.weights.sum(cell, c.samples, c.word),
                    *value = here.values + i * static_cast<size_t>(resolved.width()) + r.from;
        if (!(w > 0)) continue;
        const bool first = weight == 0;
        weight += w;
        const bool nearer = first || c.nearest < best, farther = first || c.nearest > best;
        const bool takes = r.reduce == Reduce::ZMin ? nearer : r.reduce == Reduce::ZMax ? farther : first;
        if (takes) best = c.nearest;
        for (int k = 0; k < r.width; ++k) {
          if (r.reduce == Reduce::Average)
            to[k] = (first ? 0 : to[k]) + w * value[k];
          else if (takes)
            to[k] = value[k];
          else if (r.reduce == Reduce::Min)
            to[k] = std::min(to[k], value[k]);
          else if (r.reduce == Reduce::Max)
            to[k] = std::max(to[k], value[k]);
        }
      }
    });
    for (int k = 0; r.reduce == Reduce::Average && weight > 0 && k < r.width; ++k) to[k] /= weight;
  }

  float depth(std::span<const Contribution> seen) const {
    float low = kInfinity, high = -kInfinity, sum = 0, weight = 0;
    for (const Contribution& c : seen) {
      if (c.z == kInfinity) continue;
      const bool midpoint = options.depthFilter == DepthFilter::Midpoint;
      const float z = midpoint ? 0.5f * c.z + 0.5f * std::min(c.zSecond, options.farClip) : c.z;
      low = std::min(low, z);
      high = std::max(high, z);
      if (options.depthFilter != DepthFilter::Average) continue;
      const auto count = static_cast<float>(__builtin_popcountll(c.samples));
      sum += count * z;
      weight += count;
    }
    if (low == kInfinity) return kInfinity;
    if (options.depthFilter == DepthFilter::Max) return high;
    return options.depthFilter == DepthFilter::Average ? sum / weight : low;
  }

  const DeepFrame& frame;
  const Options& options;
  const SampleOffsets& samples;
  const MatteNames names;
  const FrameOutput output;
  std::vector<Sampling> passSamplings;
  std::vector<Pass> passes;
  std::vector<Reduction> reductions;
  int reachX = 0, reachY = 0;
  ResolvedFrame resolved;
};

FrameFilter::FrameFilter(const DeepFrame& frame, const Options& options, const SampleOffsets& samples,
                         const MatteNames& names)
    : impl_(new Impl(frame, options, samples, names)) {}
FrameFilter::~FrameFilter() = default;

Image FrameFilter::shape() const {
  const PixelRect& crop = impl_->frame.crop;
  return {crop.width(), crop.height(), impl_->output.names(),      {},
          crop.x0,      crop.y0,       impl_->options.xResolution, impl_->options.yResolution};
}

Image FrameFilter::rows(int y0, int y1) {
  const PixelRect& crop = impl_->frame.crop;
  CHECK_EQ(impl_->resolved.reaches(y0 - impl_->reachY), true);
  Image image = shape();
  image.originY = y0;
  image.height = y1 - y0;
  image.pixels.resize(static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * image.channels.size());
  const auto across = static_cast<size_t>((crop.width() + kFilterBlockColumns - 1) / kFilterBlockColumns);
  const auto down = static_cast<size_t>((image.height + kFilterBlockRows - 1) / kFilterBlockRows);
  impl_->resolved.resolveRows(y0 - impl_->reachY, y1 + impl_->reachY);
  parallelFor(across * down, 1, [&](size_t begin, size_t) {
    const int x0 = crop.x0 + static_cast<int>(begin % across) * kFilterBlockColumns,
              top = y0 + static_cast<int>(begin / across) * kFilterBlockRows;
    const PixelRect block{x0, top, std::min(x0 + kFilterBlockColumns, crop.x1), std::min(top + kFilterBlockRows, y1)};
    for (const Pass& pass : impl_->passes)
      impl_->filter(pass, block, [&](int x, int y) { return image.at(x - crop.x0, y - y0); });
    for (int y = block.y0; y < block.y1; ++y) {
      for (int x = block.x0; x < block.x1; ++x)
        for (const Reduction& r : impl_->reductions) impl_->reduce(r, x, y, image.at(x - crop.x0, y - y0));
      impl_->resolved.forRow(block.x0, block.x1, y, [&](int x, const Impl::Seen& seen) {
        image.at(x - crop.x0, y - y0)[4] = impl_->depth(seen.list);
      });
    }
  });
  for (const Channel& c : impl_->output.channels)
    if (isMatte(c.kind))
      cryptomatte(impl_->frame, impl_->options, impl_->samples,
                  c.kind == ChannelKind::Objects ? impl_->names.objects : impl_->names.materials, c.first, image);
  impl_->resolved.forgetAbove(y1 - impl_->reachY);
  return image;
}

void FrameFilter::resolve(size_t index, const DeepTile& tile) { impl_->resolved.resolve(index, tile); }

PixelNoise FrameFilter::noise() const { return impl_->resolved.noise(); }

bool FrameFilter::needsTiles() const {
  const auto& channels = impl_->output.channels;
  const auto& displays = impl_->options.displays;
  return std::any_of(channels.begin(), channels.end(), [](const Channel& c) { return isMatte(c.kind); }) ||
         std::any_of(displays.begin(), displays.end(), writesDeep);
}

DeepRows FrameFilter::deepRows(int y0, int y1, const DeepMerge& merge) const {
  return tomales::deepRows(impl_->frame, impl_->options, impl_->samples, merge, y0, y1);
}

Image filterFrame(const DeepFrame& frame, const Options& options, const SampleOffsets& samples) {
  return FrameFilter(frame, options, samples).rows(frame.crop.y0, frame.crop.y1);
}

}  // namespace tomales

// Contributions -> pixels, some rows at a time.
#include <bit>
#include <map>
#include <mutex>
#include <span>

#include "reyes/base/check.h"
#include "reyes/base/parallel.h"
#include "reyes/image.h"
#include "reyes/image/composite.h"
#include "reyes/image/cryptomatte.h"
#include "reyes/image/deep_rows.h"

namespace tomales {
namespace {

constexpr int kBlockRows = 16, kBlockColumns = 256;  ///< Pixels that are filtered at a time; their contributions are in memory.

/// The floats of a pixel that share a filter.
struct Pass {
  Pass(const Sampling& s, const SampleOffsets& offsets) : weights(PixelFilter(s.filter, s.xWidth, s.yWidth), offsets) {}
  WeightTable weights;
  struct Float {
    size_t from;  ///< In a contribution.
    int to;       ///< In a pixel.
    float fill;
  };
  std::vector<Float> floats;
};

/// A channel that is not filtered.
struct Reduction {
  Reduction(const Sampling& s, const SampleOffsets& offsets)
      : reduce(s.reduce), weights(PixelFilter("box", s.xWidth, s.yWidth), offsets) {}
  Reduce reduce;
  WeightTable weights;
  size_t from = 0;
  int to = 0, width = 1;
  float fill = 0;
};

PixelNoise noiseOf(const ResolvedTile& tile, int width, int samplesPerPixel) {
  PixelNoise out;
  const auto all = static_cast<float>(samplesPerPixel);
  if (samplesPerPixel < 2) return out;
  for (size_t pixel = 0; pixel + 1 < tile.first.size(); ++pixel) {
    float sum = 0, squares = 0;
    for (size_t c = tile.first[pixel]; c < tile.first[pixel + 1]; ++c) {
      const float* color = tile.values.data() + c * static_cast<size_t>(width);
      const float light = luminance(vec3(color[0], color[1], color[2])), count = static_cast<float>(std::popcount(tile.contributions[c].samples));
      sum += count * light, squares += count * light * light;
    }
    if (!(sum > 0)) continue;
    const float mean = sum / all, variance = (squares / all - mean * mean) / (all - 1);
    out.light += mean, out.error += std::sqrt(std::max(variance, 0.0f));
  }
  return out;
}

}  // namespace

struct FrameFilter::Impl {
  Impl(const DeepFrame& f, const Options& o, const SampleOffsets& s, const MatteNames& n)
      : frame(f), options(o), samples(s), names(n), output(outputOf(o)), resolved(f.tileCount()) {
    addPass({Reduce::Filter, o.filter, o.xFilterWidth, o.yFilterWidth}).floats = {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}};
    compositors.push_back(std::make_unique<Compositor>(output, options, frame.samplesPerPixel));
    const std::vector<ExtraFloat>& extras = compositors[0]->extras();
    width = compositors[0]->width();
    for (size_t e = 0; e < extras.size(); ++e) {
      const Channel& channel = output.channels[static_cast<size_t>(extras[e].channel)];
      if (channel.sampling.reduce == Reduce::Filter)
        addPass(channel.sampling).floats.push_back({4 + e, channel.first + extras[e].component, extras[e].fill});
      else if (extras[e].component == 0)
        addReduction(channel, 4 + e);
    }
    const auto reach = [this](const WeightTable& w) { reachX = std::max(reachX, w.reachX), reachY = std::max(reachY, w.reachY); };
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
    r.from = from, r.to = channel.first, r.width = channel.width(), r.fill = channel.fill;
  }

  void resolve(size_t index, const DeepTile& tile) {
    std::unique_ptr<Compositor> compositor = takeCompositor();
    resolved[index] = std::make_unique<ResolvedTile>(compositor->resolve(tile));
    const PixelNoise here = noiseOf(*resolved[index], compositor->width(), frame.samplesPerPixel);
    const std::lock_guard lock(mutex);
    noise[index] = here;
    compositors.push_back(std::move(compositor));
  }
  std::unique_ptr<Compositor> takeCompositor() {
    const std::lock_guard lock(mutex);
    if (compositors.empty()) return std::make_unique<Compositor>(output, options, frame.samplesPerPixel);
    std::unique_ptr<Compositor> taken = std::move(compositors.back());
    compositors.pop_back();
    return taken;
  }
  /// The tiles that rows of pixels need and that nobody has brought.
  void resolveRows(int y0, int y1) {
    const auto first = firstTileOf(y0 - reachY), last = firstTileOf(y1 + reachY - 1) + static_cast<size_t>(frame.columns);
    parallelFor(last - first, 1, [&](size_t begin, size_t) {
      const size_t index = first + begin;
      const PixelRect rect = frame.rectOf(index);
      if (resolved[index]) return;
      if (const DeepTile* tile = finishedTile(frame, rect.x0, rect.y0)) resolve(index, *tile);
    });
  }
  /// Those that lie above some rows of pixels and all that their filters touch.
  void forgetAbove(int y) {
    const size_t end = firstTileOf(y - reachY);
    for (; forgotten < end; ++forgotten) resolved[forgotten].reset();
  }
  size_t firstTileOf(int y) const {
    return static_cast<size_t>(frame.rowOf(std::clamp(y, frame.padded.y0, frame.padded.y1 - 1))) * static_cast<size_t>(frame.columns);
  }

  /// What the samples of a pixel see.
  struct Seen {
    std::span<const Contribution> list;
    const float* values;  ///< `width` each.
  };
  /// Pixels of one row from (x, y) on that lie in one tile.
  struct TileRun {
    const ResolvedTile* tile;  ///< Null: they see nothing.
    size_t pixel;              ///< Of the tile, the first of them.
    int end;                   ///< The x behind them.

    Seen at(size_t i, int width) const {
      if (!tile) return {};
      const size_t begin = tile->first[pixel + i], last = tile->first[pixel + i + 1];
      return {{tile->contributions.data() + begin, last - begin}, tile->values.data() + begin * static_cast<size_t>(width)};
    }
  };
  TileRun runFrom(int x, int y) const {
    const int right = x - frame.padded.x0, column = right / frame.bucketWidth, row = frame.rowOf(y);
    const auto& tile = resolved[static_cast<size_t>(row) * static_cast<size_t>(frame.columns) + static_cast<size_t>(column)];
    const int left = column * frame.bucketWidth, tileWidth = std::min(frame.bucketWidth, frame.padded.width() - left);
    return {tile.get(), static_cast<size_t>((y - frame.padded.y0 - row * frame.bucketHeight) * tileWidth + right - left),
            frame.padded.x0 + left + tileWidth};
  }
  Seen seenAt(int x, int y) const { return runFrom(x, y).at(0, width); }
  /// Calls visit(x, seen) for the pixels [x0, x1) of a row.
  template <class Visit>
  void forRow(int x0, int x1, int y, const Visit& visit) const {
    for (int x = x0; x < x1;) {
      const TileRun run = runFrom(x, y);
      for (size_t i = 0; x < std::min(run.end, x1); ++x, ++i) visit(x, run.at(i, width));
    }
  }

  /// What the samples around bring to each pixel of a block: the floats of a pass, and the weight of those which see something. For each
  /// pixel by rows, columns and fragments.
  PixelSums sumsOf(const Pass& pass, const PixelRect& block) const {
    const size_t floats = pass.floats.size(), places = static_cast<size_t>(pass.weights.places());
    PixelSums sums(pass.weights, block, static_cast<int>(floats) + 1);
    const auto wide = static_cast<size_t>(sums.width());
    AlignedVector<float> weights, values;
    const PixelRect around = reached(block, pass.weights);
    for (int y = around.y0; y < around.y1; ++y)
      forRow(around.x0, around.x1, y, [&](int x, const Seen& here) {
        const size_t count = here.list.size();
        if (count == 0) return;
        if (weights.size() < count * places) weights.resize(count * places), values.resize(count * wide);
        const int pattern = samples.patternOf(x, y);
        for (size_t c = 0; c < count; ++c) {
          pass.weights.sums(pattern, here.list[c].samples, here.list[c].word, weights.data() + c * places);
          const float* from = here.values + c * static_cast<size_t>(width);
          float* to = values.data() + c * wide;
          for (size_t k = 0; k < floats; ++k) to[k] = from[pass.floats[k].from];
          to[floats] = 1;
        }
        sums.add(x, y, static_cast<int>(count), weights.data(), values.data());
      });
    return sums;
  }
  /// Pixels whose samples reach a block.
  PixelRect reached(const PixelRect& block, const WeightTable& w) const {
    const PixelRect& p = frame.padded;
    return {std::max(p.x0, block.x0 - w.reachX), std::max(p.y0, block.y0 - w.reachY), std::min(p.x1, block.x1 + w.reachX),
            std::min(p.y1, block.y1 + w.reachY)};
  }

  /// The sums of weights of all samples around each pixel of a block, by rows.
  std::vector<float> totalsOf(const Pass& pass, const PixelRect& block) const {
    const WeightTable& w = pass.weights;
    const PixelRect around = reached(block, w);
    const auto columns = static_cast<size_t>(around.width());
    std::vector<const float*> sums;  // of the pattern of each
    for (int y = around.y0; y < around.y1; ++y)
      for (int x = around.x0; x < around.x1; ++x) sums.push_back(w.sums(samples.patternOf(x, y)));
    std::vector<float> totals;
    for (int y = block.y0; y < block.y1; ++y)
      for (int x = block.x0; x < block.x1; ++x) {
        float total = 0;
        const int first = std::max(x - w.reachX, around.x0), last = std::min(x + w.reachX, around.x1 - 1);
        for (int sy = std::max(y - w.reachY, around.y0); sy <= std::min(y + w.reachY, around.y1 - 1); ++sy) {
          const float* const* row = sums.data() + static_cast<size_t>(sy - around.y0) * columns - around.x0;
          for (int sx = first; sx <= last; ++sx) total += row[sx][w.cell(0, sx - x, sy - y).place];
        }
        totals.push_back(total);
      }
    return totals;
  }

  void filter(const float* sum, float total, const Pass& pass, float* out) const {
    const float covered = sum[pass.floats.size()];
    for (size_t k = 0; k < pass.floats.size(); ++k) {
      const Pass::Float& f = pass.floats[k];
      const float filled = f.fill == 0 ? sum[k] : sum[k] + f.fill * (total - covered);
      out[f.to] = total != 0 ? filled / total : f.fill;
    }
  }

  void reduce(const Reduction& r, int x, int y, float* out) const {
    float weight = 0, best = 0;
    float* to = out + r.to;
    std::fill_n(to, r.width, r.fill);
    forNeighbours(frame.padded, r.weights, samples, x, y, [&](const WeightTable::Cell& cell, const ivec2& pixel) {
      const Seen here = seenAt(pixel.x, pixel.y);
      for (size_t i = 0; i < here.list.size(); ++i) {
        const Contribution& c = here.list[i];
        const float w = r.weights.sum(cell, c.samples, c.word), *value = here.values + i * static_cast<size_t>(width) + r.from;
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
      const auto count = static_cast<float>(__builtin_popcountll(c.samples));
      low = std::min(low, z), high = std::max(high, z), sum += count * z, weight += count;
    }
    if (weight == 0) return kInfinity;
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
  int width = 0;  ///< Floats of a contribution.
  std::vector<std::unique_ptr<ResolvedTile>> resolved;
  size_t forgotten = 0;  ///< Of these, from the first.
  std::mutex mutex;
  std::map<size_t, PixelNoise> noise;  ///< By tiles.
  std::vector<std::unique_ptr<Compositor>> compositors;  ///< Those that no thread uses.
};

FrameFilter::FrameFilter(const DeepFrame& frame, const Options& options, const SampleOffsets& samples, const MatteNames& names)
    : impl_(new Impl(frame, options, samples, names)) {}
FrameFilter::~FrameFilter() = default;

Image FrameFilter::shape() const {
  const PixelRect& crop = impl_->frame.crop;
  return {crop.width(), crop.height(), impl_->output.names(), {}, crop.x0, crop.y0, impl_->options.xResolution,
          impl_->options.yResolution};
}

Image FrameFilter::rows(int y0, int y1) {
  const PixelRect& crop = impl_->frame.crop;
  CHECK_GE(impl_->firstTileOf(y0 - impl_->reachY), impl_->forgotten);
  Image image = shape();
  image.originY = y0, image.height = y1 - y0;
  image.pixels.resize(static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * image.channels.size());
  const auto across = static_cast<size_t>((crop.width() + kBlockColumns - 1) / kBlockColumns);
  const auto down = static_cast<size_t>((image.height + kBlockRows - 1) / kBlockRows);
  impl_->resolveRows(y0, y1);
  parallelFor(across * down, 1, [&](size_t begin, size_t) {
    const int x0 = crop.x0 + static_cast<int>(begin % across) * kBlockColumns, top = y0 + static_cast<int>(begin / across) * kBlockRows;
    const PixelRect block{x0, top, std::min(x0 + kBlockColumns, crop.x1), std::min(top + kBlockRows, y1)};
    for (const Pass& pass : impl_->passes) {
      const PixelSums sums = impl_->sumsOf(pass, block);
      const std::vector<float> totals = impl_->totalsOf(pass, block);
      const float* total = totals.data();
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x) impl_->filter(sums.of(x, y), *total++, pass, image.at(x - crop.x0, y - y0));
    }
    for (int y = block.y0; y < block.y1; ++y) {
      for (int x = block.x0; x < block.x1; ++x)
        for (const Reduction& r : impl_->reductions) impl_->reduce(r, x, y, image.at(x - crop.x0, y - y0));
      impl_->forRow(block.x0, block.x1, y, [&](int x, const Impl::Seen& seen) { image.at(x - crop.x0, y - y0)[4] = impl_->depth(seen.list); });
    }
  });
  for (const Channel& c : impl_->output.channels)
    if (isMatte(c.kind))
      cryptomatte(impl_->frame, impl_->options, impl_->samples,
                  c.kind == ChannelKind::Objects ? impl_->names.objects : impl_->names.materials, c.first, image);
  impl_->forgetAbove(y1);
  return image;
}

void FrameFilter::resolve(size_t index, const DeepTile& tile) { impl_->resolve(index, tile); }

PixelNoise FrameFilter::noise() const {
  PixelNoise out;
  for (const auto& [tile, here] : impl_->noise) out.light += here.light, out.error += here.error;
  return out;
}

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

// Sample compositing and filtering: a band of rows is resolved into contributions first, so that a pixel is
// composited once and not once for every neighbour whose filter touches it.
#include "reyes/base/parallel.h"
#include "reyes/image.h"

namespace tomales {
namespace {

constexpr int kBandRows = 16;
constexpr float kOpaque =
    0.996f;  // RISpec-era default of Option "limits" "othreshold": what is behind is not visible.

/// Premultiplied colour and alpha of some samples of a pixel.
struct Contribution {
  vec3 color;
  float alpha;
  uint64_t samples;
  uint16_t word;
};

/// What filtering needs of the pixels of some rows: contributions of pixel i are [first[i], first[i + 1]).
struct ResolvedRows {
  PixelRect rect;
  std::vector<Contribution> contributions;
  std::vector<size_t> first;
  size_t index(int x, int y) const {
    return static_cast<size_t>(y - rect.y0) * static_cast<size_t>(rect.width()) +
           static_cast<size_t>(x - rect.x0);
  }
};

int lowestBit(uint64_t mask) { return __builtin_ctzll(mask); }

struct FacetShade {
  vec3 color, opacity, coverage;  ///< coverage: opacity, or 0 for a matte facet.
};

FacetShade facetShade(const DeepTile& tile, const Fragment& fragment) {
  const Facet& facet = tile.facets[fragment.facet];
  const ShadedPoints& shaded = tile.shaded[static_cast<size_t>(facet.batch)];
  FacetShade out{shaded.color(facet.point[0]), shaded.opacity(facet.point[0]), vec3(0.0f)};
  if (facet.point[1] != facet.point[0] || facet.point[2] != facet.point[0]) {
    const float u = static_cast<float>(fragment.u) / 255, v = static_cast<float>(fragment.v) / 255;
    const float weight[4] = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
    out.color *= weight[0], out.opacity *= weight[0];
    for (int i = 1; i < 4; ++i) {
      out.color += weight[i] * shaded.color(facet.point[i]);
      out.opacity += weight[i] * shaded.opacity(facet.point[i]);
    }
  }
  if (facet.matte)
    out.color = vec3(0.0f);
  else
    out.coverage = out.opacity;
  return out;
}

float meanOf(const vec3& v) { return (v.x + v.y + v.z) / 3; }

/// Composites the fragments of pixels, one at a time; keeps its scratch memory.
class Compositor {
 public:
  explicit Compositor(int samples)
      : seen_(static_cast<size_t>(samples + 63) / 64), samples_(seen_.size() * 64) {}

  void resolve(const DeepTile& tile, const DeepPixel& pixel, std::vector<Contribution>& out) {
    const Fragment* begin = tile.fragments.data() + pixel.first;
    const Fragment* end = begin + pixel.count;
    if (disjoint(begin, end)) {
      for (const Fragment* f = begin; f != end; ++f) {
        const FacetShade s = facetShade(tile, *f);
        out.push_back({s.color, meanOf(s.coverage), f->samples, f->word});
      }
    } else {
      composite(tile, begin, end);
      emit(out);
    }
  }

 private:
  struct Sample {
    vec3 color{0.0f}, coverage{0.0f}, clear{1.0f};
  };

  bool disjoint(const Fragment* begin, const Fragment* end) {
    std::fill(seen_.begin(), seen_.end(), 0);
    bool overlap = false;
    for (const Fragment* f = begin; f != end; ++f) {
      overlap |= (seen_[f->word] & f->samples) != 0;
      seen_[f->word] |= f->samples;
    }
    return !overlap;
  }

  // Front to back "over" with an opacity for each channel.
  void composite(const DeepTile& tile, const Fragment* begin, const Fragment* end) {
    std::fill(samples_.begin(), samples_.end(), Sample{});
    for (const Fragment* f = begin; f != end; ++f) {
      const FacetShade shade = facetShade(tile, *f);
      for (uint64_t left = f->samples; left; left &= left - 1) {
        Sample& s = samples_[static_cast<size_t>(f->word) * 64 + static_cast<size_t>(lowestBit(left))];
        if (maxComponent(s.clear) <= 1 - kOpaque) continue;
        s.color += s.clear * shade.color;
        s.coverage += s.clear * shade.coverage;
        s.clear *= vec3(1.0f) - shade.opacity;
      }
    }
  }

  void emit(std::vector<Contribution>& out) const {
    for (size_t word = 0; word < seen_.size(); ++word)
      for (uint64_t left = seen_[word]; left; left &= left - 1) {
        const Sample& s = samples_[word * 64 + static_cast<size_t>(lowestBit(left))];
        out.push_back({s.color, meanOf(s.coverage), left & (~left + 1), static_cast<uint16_t>(word)});
      }
  }

  std::vector<uint64_t> seen_;  ///< Samples that any fragment covers.
  std::vector<Sample> samples_;
};

/// Filter weights of every sample of a pixel at (dx, dy) from the pixel that is being filtered.
class WeightTable {
 public:
  WeightTable(const PixelFilter& filter, const SampleOffsets& samples)
      : reachX(filter.reachX()), reachY(filter.reachY()), count_(static_cast<size_t>(samples.count)) {
    for (const std::vector<vec2>& offsets : samples.byPattern)
      for (int dy = -reachY; dy <= reachY; ++dy)
        for (int dx = -reachX; dx <= reachX; ++dx) {
          float sum = 0;
          for (const vec2& o : offsets) {
            weights_.push_back(
                filter(static_cast<float>(dx) + o.x - 0.5f, static_cast<float>(dy) + o.y - 0.5f));
            sum += weights_.back();
          }
          sums_.push_back(sum);
        }
  }

  const int reachX, reachY;
  size_t cell(int pattern, int dx, int dy) const {
    const int columns = 2 * reachX + 1, rows = 2 * reachY + 1;
    return static_cast<size_t>((pattern * rows + dy + reachY) * columns + dx + reachX);
  }
  float sum(size_t cell) const { return sums_[cell]; }
  float sum(size_t cell, uint64_t mask, uint16_t word) const {
    const float* w = weights_.data() + cell * count_ + static_cast<size_t>(word) * 64;
    float sum = 0;
    for (; mask; mask &= mask - 1) sum += w[lowestBit(mask)];
    return sum;
  }

 private:
  size_t count_;
  std::vector<float> weights_, sums_;
};

/// The tile of a pixel, or null where an interrupted frame has none.
const DeepTile* finishedTile(const DeepFrame& frame, int x, int y) {
  const DeepTile& tile = frame.tileAt(x, y);
  return tile.pixels.empty() || tile.shaded.size() < tile.batches.size() ? nullptr : &tile;
}

ResolvedRows resolveRows(const DeepFrame& frame, const PixelRect& rect) {
  ResolvedRows rows{rect, {}, {0}};
  Compositor compositor(frame.samplesPerPixel);
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) {
      if (const DeepTile* tile = finishedTile(frame, x, y))
        compositor.resolve(*tile, tile->pixel(x, y), rows.contributions);
      rows.first.push_back(rows.contributions.size());
    }
  return rows;
}

vec4 filterPixel(const ResolvedRows& rows, const WeightTable& weights, const SampleOffsets& samples, int x,
                 int y) {
  vec4 sum(0.0f);
  float total = 0;
  for (int sy = std::max(y - weights.reachY, rows.rect.y0);
       sy < std::min(y + weights.reachY + 1, rows.rect.y1); ++sy)
    for (int sx = std::max(x - weights.reachX, rows.rect.x0);
         sx < std::min(x + weights.reachX + 1, rows.rect.x1); ++sx) {
      const size_t cell = weights.cell(samples.patternOf(sx, sy), sx - x, sy - y);
      total += weights.sum(cell);
      const size_t pixel = rows.index(sx, sy);
      for (size_t i = rows.first[pixel]; i < rows.first[pixel + 1]; ++i) {
        const Contribution& c = rows.contributions[i];
        sum += weights.sum(cell, c.samples, c.word) * vec4(c.color, c.alpha);
      }
    }
  return total != 0 ? sum / total : vec4(0.0f);
}

float nearestDepth(const DeepFrame& frame, int x, int y) {
  const DeepTile* tile = finishedTile(frame, x, y);
  const DeepPixel pixel = tile ? tile->pixel(x, y) : DeepPixel{};
  float z = kInfinity;
  for (uint32_t i = 0; i < pixel.count; ++i) z = std::min(z, tile->fragments[pixel.first + i].z);
  return z;
}

}  // namespace

Image filterFrame(const DeepFrame& frame, const Options& options, const SampleOffsets& samples) {
  const PixelRect& crop = frame.crop;
  Image image{crop.width(), crop.height(), {"R", "G", "B", "A", "Z"}, {},
              crop.x0,      crop.y0,       options.xResolution,       options.yResolution};
  image.pixels.resize(static_cast<size_t>(image.width) * static_cast<size_t>(image.height) *
                      image.channels.size());
  const WeightTable weights(PixelFilter(options.filter, options.xFilterWidth, options.yFilterWidth), samples);
  parallelFor(static_cast<size_t>(image.height), kBandRows, [&](size_t begin, size_t end) {
    const int y0 = crop.y0 + static_cast<int>(begin), y1 = crop.y0 + static_cast<int>(end);
    const ResolvedRows rows =
        resolveRows(frame, {frame.padded.x0, std::max(frame.padded.y0, y0 - weights.reachY), frame.padded.x1,
                            std::min(frame.padded.y1, y1 + weights.reachY)});
    for (int y = y0; y < y1; ++y)
      for (int x = crop.x0; x < crop.x1; ++x) {
        const vec4 p = filterPixel(rows, weights, samples, x, y);
        float* out = image.at(x - crop.x0, y - crop.y0);
        out[0] = p.x, out[1] = p.y, out[2] = p.z, out[3] = p.w;
        out[4] = nearestDepth(frame, x, y);
      }
  });
  return image;
}

}  // namespace tomales

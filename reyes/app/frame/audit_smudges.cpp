#include "reyes/app/frame/audit_smudges.h"

#include <algorithm>
#include <mutex>
#include <tuple>

#include "reyes/app/frame/audit_pixels.h"
#include "reyes/base/parallel.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/frame.h"
#include "reyes/image_compare.h"

namespace tomales {
namespace {

constexpr int kCellsAcross = 8;  ///< Pixels that are looked at along each edge of a block, one in each cell of a grid.
constexpr int kPixelsOfBlock = kCellsAcross * kCellsAcross;
/// Paths at each point in each of the two sets: the least number at first, which is then doubled until the sets are
/// quiet.
constexpr int kFewestPathsOfBlocks = 16, kMostPathsOfBlocks = 64;
constexpr double kQuietBlocks = 0.5;  ///< Paths are added while the noise exceeds this share of the deviation.
constexpr int kBothHalves = 2;

/// Returns the set of rays to which this pixel belongs, in blocks where some pixels are left out. The sets have
/// separate pixels, so their difference includes the effect of the choice of pixels.
int halfOfCell(int cell) { return (cell % kCellsAcross + cell / kCellsAcross) % 2; }

struct BlockMeans {
  double picture[2] = {0, 0}, right[2] = {0, 0};
};

}  // namespace

/// The pixels of a block in one tile.
struct SmudgeAudit::Part {
  size_t block;
  int half;  ///< The set of rays that sees them, or kBothHalves.
  DeepTile tile;
  std::vector<ivec2> pixels;
  std::vector<int> cells;  ///< Cell of each pixel.
};

struct SmudgeAudit::Blocks {
  int size = 0;
  std::vector<ivec2> corners;
  std::vector<Part> parts;
  std::vector<float> sets[2];  ///< True luminance at each cell of each block.
  int rays = 0;                ///< Number of rays in each set.

  bool isWhole() const { return size == kCellsAcross; }
  ivec2 pixelOf(size_t block, int cell, uint32_t seed) const {
    const int step = size / kCellsAcross;
    const uint32_t place = hashCombine(static_cast<uint32_t>(corners[block].x), static_cast<uint32_t>(corners[block].y),
                                       static_cast<uint32_t>(cell), seed);
    const uint32_t at = hashCombine(place, randomStream("cell")) % static_cast<uint32_t>(step * step);
    return corners[block] + ivec2(cell % kCellsAcross, cell / kCellsAcross) * step +
           ivec2(static_cast<int>(at) % step, static_cast<int>(at) / step);
  }
};

SmudgeAudit::SmudgeAudit(const DeepFrame& layout, const TileReader& tiles, const Scene& scene,
                         const ShadingSystem& shading, const SmudgeSettings& settings, StopToken stop)
    : layout_(layout),
      tiles_(tiles),
      scene_(scene),
      shading_(shading),
      settings_(settings),
      stop_(stop),
      across_((layout.padded.width() + kCellsAcross - 1) / kCellsAcross),
      covered_(static_cast<size_t>(across_) *
               static_cast<size_t>((layout.padded.height() + kCellsAcross - 1) / kCellsAcross)) {
  if (settings.sizes == 0) return;
  std::mutex counting;
  parallelFor(layout.tileCount(), 1, [&](size_t t, size_t) {
    const auto tile = stop_.requested() ? nullptr : tiles(t);
    if (!tile) return;
    const std::lock_guard lock(counting);
    for (int y = tile->rect.y0; y < tile->rect.y1; ++y)
      for (int x = tile->rect.x0; x < tile->rect.x1; ++x) covered_[cellAt(x, y)] += tile->pixel(x, y).count > 0;
  });
  for (size_t i = 0; i < std::min(settings.sizes, kSmudgeSizes.size()); ++i) add(kSmudgeSizes[i]);
}

SmudgeAudit::~SmudgeAudit() = default;

size_t SmudgeAudit::cellAt(int x, int y) const {
  return static_cast<size_t>((y - layout_.padded.y0) / kCellsAcross) * static_cast<size_t>(across_) +
         static_cast<size_t>((x - layout_.padded.x0) / kCellsAcross);
}

/// Chooses blocks of this size from a grid whose blocks each lie within one tile.
void SmudgeAudit::add(int size) {
  const PixelRect &crop = layout_.crop, &all = layout_.padded;
  std::vector<std::pair<uint32_t, ivec2>> order;
  for (int top = all.y0; top + size <= crop.y1; top += size)
    for (int left = all.x0; left + size <= crop.x1; left += size) {
      bool isCovered = left >= crop.x0 && top >= crop.y0;
      for (int y = top; y < top + size && isCovered; y += kCellsAcross)
        for (int x = left; x < left + size && isCovered; x += kCellsAcross)
          isCovered = covered_[cellAt(x, y)] == kPixelsOfBlock;
      const uint32_t place = hashCombine(static_cast<uint32_t>(left), static_cast<uint32_t>(top));
      if (isCovered)
        order.emplace_back(hashCombine(place, settings_.seed, randomStream("bloc"), static_cast<uint32_t>(size)),
                           ivec2(left, top));
    }
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return std::tuple(a.first, a.second.y, a.second.x) < std::tuple(b.first, b.second.y, b.second.x);
  });
  order.resize(std::min(order.size(), settings_.blocks));
  if (order.size() < SmudgeEstimate::kFewestBlocks) return;
  Blocks blocks;
  blocks.size = size;
  for (const auto& [hash, corner] : order) blocks.corners.push_back(corner);
  copyPixelsOf(blocks);
  sizes_.push_back(std::move(blocks));
}

void SmudgeAudit::copyPixelsOf(Blocks& blocks) {
  std::vector<std::vector<Part>> byTile(layout_.tileCount());
  for (size_t b = 0; b < blocks.corners.size(); ++b)
    for (int cell = 0; cell < kPixelsOfBlock; ++cell) {
      const ivec2 at = blocks.pixelOf(b, cell, settings_.seed);
      const size_t t = layout_.tileOf(at.x, at.y);
      const int half = blocks.isWhole() ? kBothHalves : halfOfCell(cell);
      auto part = std::find_if(byTile[t].begin(), byTile[t].end(),
                               [&](const Part& p) { return p.block == b && p.half == half; });
      if (part == byTile[t].end()) part = byTile[t].insert(part, {b, half, {}, {}, {}});
      part->pixels.push_back(at);
      part->cells.push_back(cell);
    }
  parallelFor(byTile.size(), 1, [&](size_t t, size_t) {
    if (byTile[t].empty() || stop_.requested()) return;
    const auto tile = tiles_(t);
    for (Part& part : byTile[t]) {
      PixelRect around{part.pixels[0].x, part.pixels[0].y, part.pixels[0].x + 1, part.pixels[0].y + 1};
      for (const ivec2& at : part.pixels) {
        around.x0 = std::min(around.x0, at.x);
        around.x1 = std::max(around.x1, at.x + 1);
        around.y0 = std::min(around.y0, at.y);
        around.y1 = std::max(around.y1, at.y + 1);
      }
      if (tile) part.tile = copyPixels(*tile, around, part.pixels);
    }
  });
  for (std::vector<Part>& parts : byTile)
    for (Part& part : parts)
      if (!part.tile.pixels.empty()) blocks.parts.push_back(std::move(part));
}

/// Returns the luminance at each cell of each block; 0 at the cells of the other half.
std::vector<float> SmudgeAudit::shade(const Blocks& blocks, const ShadeContext& context, int half) const {
  std::vector<float> out(blocks.corners.size() * kPixelsOfBlock);
  parallelFor(blocks.parts.size(), 1, [&](size_t p, size_t) {
    const Part& part = blocks.parts[p];
    if (stop_.requested() || (half != kBothHalves && part.half != kBothHalves && part.half != half)) return;
    DeepTile tile = part.tile;
    shadeTile(tile, scene_, shading_, context);
    for (size_t i = 0; i < part.pixels.size(); ++i)
      out[part.block * kPixelsOfBlock + static_cast<size_t>(part.cells[i])] =
          luminance(colorOf(tile, part.pixels[i], layout_.samplesPerPixel).mean);
  });
  return out;
}

/// Adds `rays` to each of the two sets.
void SmudgeAudit::addSets(Blocks& blocks, ShadeContext context, int rays) const {
  context.auditPaths = rays;
  context.lightSamples = settings_.lightSamples;
  const float share = static_cast<float>(rays) / static_cast<float>(blocks.rays + rays);
  for (uint32_t set = 0; set < 2; ++set) {
    context.seed = hashCombine(settings_.seed, randomStream("even"), static_cast<uint32_t>(blocks.size),
                               2 * static_cast<uint32_t>(blocks.rays) + set);
    std::vector<float>& mean = blocks.sets[set];
    const std::vector<float> more = shade(blocks, context, static_cast<int>(set));
    mean.resize(more.size());
    for (size_t i = 0; i < mean.size(); ++i) mean[i] += share * (more[i] - mean[i]);
  }
  blocks.rays += rays;
}

SmudgeEstimate SmudgeAudit::estimate(const Blocks& blocks, const std::vector<float>& picture) const {
  std::vector<SmoothBlock> smooth;
  for (size_t b = 0; b < blocks.corners.size(); ++b) {
    const auto at = [&](const std::vector<float>& of, int cell) {
      return double{of[b * kPixelsOfBlock + static_cast<size_t>(cell)]};
    };
    BlockMeans mean;
    const double count = blocks.isWhole() ? kPixelsOfBlock : kPixelsOfBlock / 2;
    for (int cell = 0; cell < kPixelsOfBlock; ++cell)
      for (int set = 0; set < 2; ++set) {
        if (!blocks.isWhole() && halfOfCell(cell) != set) continue;
        mean.picture[set] += at(picture, cell) / count;
        mean.right[set] += at(blocks.sets[set], cell) / count;
      }
    // Noise of both sets is independent, so that it is not in this variance.
    double variance = 0;
    for (int cell = 0; cell < kPixelsOfBlock; ++cell) {
      if (!blocks.isWhole() && halfOfCell(cell) != 0) continue;
      const int other = blocks.isWhole() ? cell : cell ^ 1;
      variance += (at(blocks.sets[0], cell) - mean.right[0]) * (at(blocks.sets[1], other) - mean.right[1]) / count;
    }
    const double right = 0.5 * (mean.right[0] + mean.right[1]);
    if (!isSmooth(right, variance)) continue;
    smooth.push_back({(mean.picture[0] - mean.right[0]) / right, (mean.picture[1] - mean.right[1]) / right});
  }
  return estimateSmudges(blocks.size, smooth);
}

std::vector<SmudgeEstimate> SmudgeAudit::of(const ShadeContext& given) {
  std::vector<SmudgeEstimate> out;
  ShadeContext context = given;
  context.purpose = Purpose::Sketch;
  for (Blocks& blocks : sizes_) {
    const std::vector<float> picture = shade(blocks, context, kBothHalves);
    if (blocks.rays == 0) addSets(blocks, context, kFewestPathsOfBlocks);
    SmudgeEstimate found = estimate(blocks, picture);
    const auto quiet = [&] { return kQuietBlocks * std::max(found.deviation, settings_.leastDeviation); };
    while (found.isKnown() && found.noise > quiet() && 2 * blocks.rays <= kMostPathsOfBlocks && !stop_.requested()) {
      addSets(blocks, context, blocks.rays);
      found = estimate(blocks, picture);
    }
    if (found.isKnown()) out.push_back(found);
  }
  return out;
}

}  // namespace tomales

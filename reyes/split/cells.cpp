// Chooses the numbers of cells along two lines that have been measured.
#include <bit>
#include <cmath>

#include "reyes/split/rate.h"

namespace tomales {
namespace {

/// Greatest distance of a chord from its arc, at any shading rate: the error of a silhouette (docs/decisions/0034).
constexpr float kFlat_px = 0.25f;
/// Greatest turn of a blurred cell in radians. A blurred chord may leave its arc by more, but must not cover less: with
/// this limit circles keep 0.97 of their area. It does not apply where a sharp cell would turn by more.
constexpr float kTurn = 0.4f;
/// Closed lines have an even number of cells up to this limit, so that their middle, where a ball is widest, is a line
/// of the grid.
constexpr int kFewOfRound = 10;
constexpr float kMostCells = 65536;

/// Greatest length of an edge over that of a square of the required area.
constexpr float kLongest = 1.5f;
/// Rounding may reduce the number of cells by this factor.
constexpr float kFewer = 0.9f;
/// A ratio must be closer to 1 by more than this to count as better, so that rounding does not decide how a square
/// piece is cut.
constexpr float kSquarer = 0.9999f;

/// Returns whole numbers of cells for two lines with these exact numbers: the fewest that cover the area, and the
/// squarest of these.
Cells fewest(float alongU, float alongV, int leastU, int leastV) {
  Cells best{0, 0};
  float bestEdge = kInfinity;
  for (const float tried : {std::floor(alongU), std::ceil(alongU), alongU / kLongest}) {
    const int nu = std::max(leastU, static_cast<int>(std::ceil(tried)));
    const int nv = std::max(leastV, static_cast<int>(std::ceil(kFewer * alongU * alongV / static_cast<float>(nu))));
    const float edge = std::max(alongU / static_cast<float>(nu), alongV / static_cast<float>(nv));
    const int64_t count = int64_t{nu} * nv, fewestYet = int64_t{best.nu} * best.nv;
    if (best.nu > 0 && (count > fewestYet || (count == fewestYet && edge >= kSquarer * bestEdge))) continue;
    best = {nu, nv};
    bestEdge = edge;
  }
  return best;
}

/// Returns the turn of an arc in radians. An arc of radius r that turns by t has a length of r t, and the second
/// difference of its quarters is 2 r (1 - cos(t / 4)). The result solves that for t, within 3 % up to a full circle.
float turnOf(const LineSize& line) {
  const float bend = line.px > 0 ? line.bend_px / line.px : 0.0f;
  return 16 * bend * (1 + 2.3f * bend * bend);
}

/// Returns the least number of cells at any rate, so that the shape does not collapse where blur lets edges grow, and
/// chords are flat.
int leastOf(const LineSize& line, const CellRules& rules) {
  constexpr float kLeastOfCoarse = 4;
  // The hider knows how far a line bulges if it has two chords or more, and closes cracks by that
  // (docs/decisions/0003).
  constexpr float kOneChord_px = 0.05f;
  // If the second difference of a line's quarters is bend_px, its n-th part bulges by 2 bend_px / n^2.
  const auto within = [&](float px) { return std::min(std::ceil(std::sqrt(2 * line.bend_px / px)), 64.0f); };
  const float fine = std::ceil(line.px / (kLongest * rules.edge_px)),
              coarse = std::ceil(line.px / (kLongest * rules.edge_px * rules.coarsening));
  const float turning = std::ceil(turnOf(line) / kTurn);
  const float flat = std::max(within(kFlat_px * rules.coarsening), std::min(turning, std::max(within(kFlat_px), fine)));
  const float n = std::max({coarse, std::min(fine, kLeastOfCoarse), static_cast<float>(line.least), flat,
                            rules.joins && 2 * line.bend_px > kOneChord_px ? 2.0f : 1.0f});
  return n >= 1.0f ? static_cast<int>(std::min(n, kMostCells)) : 1;
}

}  // namespace

Cells cells(const PatchSize& size, const CellRules& rules) {
  const float square = size.area_px2 / (size.u.px * size.v.px);
  const float edges = std::sqrt(square < 1.0f ? square : 1.0f) / (rules.edge_px * rules.coarsening);
  const auto along = [&](const LineSize& line) {
    return line.px > 0 && edges > 0 ? std::min(line.px * edges, kMostCells) : 0.0f;
  };
  const Cells n = fewest(along(size.u), along(size.v), leastOf(size.u, rules), leastOf(size.v, rules));
  const auto whole = [&](int count, const LineSize& line) {
    if (rules.binary) return static_cast<int>(std::bit_ceil(static_cast<unsigned>(count)));
    return line.least > 1 && count < kFewOfRound ? count + count % 2 : count;
  };
  return {whole(n.nu, size.u), whole(n.nv, size.v)};
}

}  // namespace tomales

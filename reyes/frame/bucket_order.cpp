#include "reyes/frame/bucket_order.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

/// Returns the distance along the Hilbert curve that fills a square of 2^k cells (Warren, Hacker's Delight, section
/// 16-2).
uint64_t alongHilbertCurve(uint32_t x, uint32_t y, uint32_t side) {
  uint64_t distance = 0;
  for (uint32_t s = side / 2; s > 0; s /= 2) {
    const uint32_t right = (x & s) != 0, up = (y & s) != 0;
    distance += uint64_t{s} * s * ((3 * right) ^ up);
    if (up) continue;
    if (right) {
      x = side - 1 - x;
      y = side - 1 - y;
    }
    std::swap(x, y);
  }
  return distance;
}

/// Returns a key of the ring around the middle, and of the place on it, clockwise from its top left corner.
uint64_t alongSpiral(int column, int row, int columns, int rows) {
  const int x = 2 * column - (columns - 1), y = 2 * row - (rows - 1);  // coordinates from the middle, in half buckets
  const int ring = (std::max(std::abs(x), std::abs(y)) + 1) / 2;
  const auto side = static_cast<uint64_t>(2 * ring + 2);
  const int left = x / 2 + ring, down = y / 2 + ring;
  const bool top = std::abs(y) >= std::abs(x) && y < 0, bottom = std::abs(y) >= std::abs(x) && y >= 0;
  const uint64_t place = top      ? static_cast<uint64_t>(left)
                         : bottom ? 3 * side - static_cast<uint64_t>(left)
                         : x > 0  ? side + static_cast<uint64_t>(down)
                                  : 4 * side - static_cast<uint64_t>(down);
  return static_cast<uint64_t>(ring) << 32 | place;
}

}  // namespace

std::vector<uint32_t> bucketOrder(const std::string& order, int columns, int rows) {
  const uint32_t side = std::bit_ceil(static_cast<uint32_t>(std::max({columns, rows, 1})));
  const auto key = [&](int c, int r) -> uint64_t {
    const auto pair = [](int major, int minor) {
      return static_cast<uint64_t>(major) << 32 | static_cast<uint32_t>(minor);
    };
    if (order == "vertical") return pair(c, r);
    if (order == "zigzag-x") return pair(r, r % 2 ? columns - c : c);
    if (order == "zigzag-y") return pair(c, c % 2 ? rows - r : r);
    if (order == "spacefill") return alongHilbertCurve(static_cast<uint32_t>(c), static_cast<uint32_t>(r), side);
    if (order == "spiral") return alongSpiral(c, r, columns, rows);
    if (order == "random") return hashCombine(static_cast<uint32_t>(c), static_cast<uint32_t>(r));
    return pair(r, c);
  };
  std::vector<uint64_t> keys;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) keys.push_back(key(c, r));
  std::vector<uint32_t> out(keys.size());
  std::iota(out.begin(), out.end(), 0u);
  std::stable_sort(out.begin(), out.end(), [&](uint32_t a, uint32_t b) { return keys[a] < keys[b]; });
  return out;
}

}  // namespace tomales

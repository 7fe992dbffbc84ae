// Which opaque cells the samples of a pixel see: for the first sample that is left, all that see the same cell at once.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reyes/hide/opaque_sights.cpp"
#include "reyes/base/vector.h"  // Includes this file again for each target.

#include "reyes/hide/pixel_layers.h"
#include "reyes/hide/samples.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

/// Bits of up to 64 lanes whose cell is `cell`, and the least of their depths.
HWY_INLINE uint64_t lanesOf(const uint32_t* cells, const float* depths, size_t lanes, uint32_t cell, float& nearest) {
  uint64_t bits = 0;
  Floats least = all(kInfinity);
  for (size_t g = 0; g < lanes; g += hn::Lanes(kF)) {
    const auto same = hn::RebindMask(kF, hn::Eq(hn::Load(kU, cells + g), hn::Set(kU, cell)));
    bits |= bitsOf(same) << g;
    least = hn::Min(least, hn::IfThenElse(same, hn::Load(kF, depths + g), all(kInfinity)));
  }
  nearest = hn::GetLane(hn::MinOfLanes(kF, least));
  return bits;
}

void collect(const SampleBuffer& samples, size_t pixel, std::vector<Sight>& sights) {
  const size_t lanes = static_cast<size_t>(samples.lanes);
  for (size_t first = 0; first < lanes; first += 64) {
    const size_t here = std::min<size_t>(64, lanes - first);
    const uint32_t* cells = samples.cell.data() + pixel * lanes + first;
    const float* depths = samples.depth.data() + pixel * lanes + first;
    float nearest;
    uint64_t left = ~lanesOf(cells, depths, here, kNoCell, nearest);
    if (here < 64) left &= (uint64_t{1} << here) - 1;
    while (left) {
      Sight& sight = sights.emplace_back();  // In place: a copy would wait for its parts to be written.
      sight.cell = cells[std::countr_zero(left)], sight.word = static_cast<uint32_t>(first / 64);
      sight.depths = depths, sight.opaque = true;
      sight.samples = lanesOf(cells, depths, here, sight.cell, sight.d);
      left &= ~sight.samples;
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tomales {
HWY_EXPORT(collect);
void collectOpaque(const SampleBuffer& samples, size_t pixel, std::vector<Sight>& sights) {
  HWY_DYNAMIC_DISPATCH(collect)(samples, pixel, sights);
}
}  // namespace tomales
#endif

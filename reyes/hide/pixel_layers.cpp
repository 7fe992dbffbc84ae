#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reyes/hide/pixel_layers.cpp"
#include "reyes/base/vector.h"  // Includes this file again for each target.

#include <algorithm>
#include <bit>

#include "reyes/hide/pixel_layers.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

using Queues = PixelLayers::Queues;

/// Calls f(queue) for the lanes of a mask that counts from `first`.
template <class F>
HWY_INLINE void forLanes(Mask mask, size_t first, const F& f) {
  for (uint64_t left = bitsOf(mask); left; left &= left - 1) f(first + static_cast<size_t>(std::countr_zero(left)));
}

void merge(Queues& q, std::span<const CellCoverage> coverages, const PixelLayers::Nearer& nearer,
           std::vector<CellCoverage>& merged) {
  const size_t lanes = q.d.size();
  const auto at = [&](uint32_t coverage, float d) {
    CellCoverage out = coverages[coverage];
    out.d = d;
    return out;
  };
  for (;;) {
    Floats least = all(PixelLayers::kNone_d);
    for (size_t g = 0; g < lanes; g += hn::Lanes(kF)) least = hn::Min(least, hn::Load(kF, q.d.data() + g));
    const float d = hn::GetLane(hn::MinOfLanes(kF, least));
    if (d == PixelLayers::kNone_d) return;
    uint32_t front = PixelLayers::kNone;
    for (size_t g = 0; g < lanes; g += hn::Lanes(kF))
      forLanes(hn::Eq(hn::Load(kF, q.d.data() + g), all(d)), g, [&](size_t queue) {
        const uint32_t coverage = q.coverage[queue];
        if (coverage != front && (front == PixelLayers::kNone || nearer(at(coverage, d), at(front, d))))
          front = coverage;
      });
    CellCoverage taken = at(front, d);
    taken.samples = 0;
    for (size_t g = 0; g < lanes; g += hn::Lanes(kF)) {
      const auto same = hn::Eq(hn::Load(kU, q.coverage.data() + g), hn::Set(kU, front));
      forLanes(hn::RebindMask(kF, same), g, [&](size_t queue) {
        taken.samples |= uint64_t{1} << (q.sample[queue] % 64);
        ++q.next[queue];
        q.show(queue);
      });
    }
    merged.push_back(taken);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tomales {
namespace {

/// Calls f(sample, depth) for the samples of a coverage.
template <class F>
void forSamples(const CellCoverage& coverage, const F& f) {
  for (uint64_t left = coverage.samples; left; left &= left - 1) {
    const auto bit = static_cast<size_t>(std::countr_zero(left));
    f(size_t{coverage.word} * 64 + bit, coverage.depths[bit]);
  }
}

}  // namespace

void PixelLayers::Queues::resize(size_t queues) {
  const auto lanes = static_cast<size_t>(padded(static_cast<int>(queues)));
  d.assign(lanes, kNone_d);
  coverage.assign(lanes, kNone);
  next.resize(queues);
  end.resize(queues);
  sample.resize(queues);
}

std::span<const CellCoverage> PixelLayers::nextRun(std::span<const CellCoverage> coverages) {
  size_t n = 1;
  for (float far = coverages[0].far; n < coverages.size() && coverages[n].d <= far; ++n)
    far = std::max(far, coverages[n].far);
  return coverages.first(n);
}

/// Tells whether a sample sees two of the cells.
bool PixelLayers::overlap(std::span<const CellCoverage> coverages) {
  std::fill(covered_.begin(), covered_.end(), 0);
  bool twice = false;
  for (const CellCoverage& s : coverages) {
    if (covered_.size() <= s.word) covered_.resize(size_t{s.word} + 1, 0);
    twice |= (covered_[s.word] & s.samples) != 0;
    covered_[s.word] |= s.samples;
  }
  return twice;
}

/// Tells whether the list is nearest first for every sample. It also counts the layers of each sample.
bool PixelLayers::inOrder(std::span<const CellCoverage> coverages) {
  size_t words = 0;
  for (const CellCoverage& s : coverages) words = std::max(words, size_t{s.word} + 1);
  last_.assign(words * 64, -kNone_d);
  counts_.assign(words * 64, 0);
  bool ordered = true;
  for (const CellCoverage& coverage : coverages)
    forSamples(coverage, [&](size_t sample, float d) {
      ordered &= d >= last_[sample];
      last_[sample] = d;
      ++counts_[sample];
    });
  return ordered;
}

void PixelLayers::listLayers(std::span<const CellCoverage> coverages) {
  queues_.resize(static_cast<size_t>(std::count_if(counts_.begin(), counts_.end(), [](uint32_t n) { return n > 0; })));
  uint32_t total = 0;
  for (uint32_t sample = 0, queue = 0; sample < counts_.size(); ++sample) {
    const uint32_t count = counts_[sample];
    counts_[sample] = queue;  // from here on it is the sample's queue
    if (count == 0) continue;
    queues_.next[queue] = queues_.end[queue] = total;
    queues_.sample[queue] = sample;
    total += count;
    ++queue;
  }
  std::vector<Layer>& layers = queues_.layers;
  layers.resize(total);
  // The list is nearly sorted already. Equal depths keep the order of the list, which does not depend on the schedule.
  for (uint32_t k = 0; k < coverages.size(); ++k)
    forSamples(coverages[k], [&](size_t sample, float d) {
      const uint32_t queue = counts_[sample];
      uint32_t at = queues_.end[queue]++;
      for (; at > queues_.next[queue] && layers[at - 1].d > d; --at) layers[at] = layers[at - 1];
      layers[at] = {d, k};
    });
  for (size_t queue = 0; queue < queues_.next.size(); ++queue) queues_.show(queue);
}

HWY_EXPORT(merge);
void PixelLayers::order(std::vector<CellCoverage>& coverages, const Nearer& nearer) {
  // Most coverages are in order already and stay where they are: `merged_` begins with the first that are not.
  bool changed = false;
  for (std::span<const CellCoverage> left(coverages); !left.empty();) {
    const std::span<const CellCoverage> run = nextRun(left);
    const bool ordered = run.size() == 1 || !overlap(run) || inOrder(run);
    if (!ordered && !changed) merged_.assign(coverages.begin(), coverages.end() - static_cast<ptrdiff_t>(left.size()));
    changed |= !ordered;
    left = left.subspan(run.size());
    if (!ordered) {
      listLayers(run);
      HWY_DYNAMIC_DISPATCH(merge)(queues_, run, nearer, merged_);
    } else if (changed) {
      merged_.insert(merged_.end(), run.begin(), run.end());
    }
  }
  if (changed) coverages.swap(merged_);
}

}  // namespace tomales
#endif

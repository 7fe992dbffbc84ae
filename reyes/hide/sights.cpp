// For the first sample that is left, all that see the same cell at once.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reyes/hide/sights.cpp"
#include "reyes/base/vector.h"  // Includes this file again for each target.

#include "reyes/hide/sights.h"

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

/// Of the lanes that are left.
HWY_INLINE void collect(const uint32_t* cells, const float* depths, size_t lanes, uint64_t left, uint32_t word, float farthest,
                        std::vector<Sight>& sights) {
  while (left) {
    Sight& sight = sights.emplace_back();  // In place: a copy would wait for its parts to be written.
    sight.cell = cells[std::countr_zero(left)], sight.word = word;
    sight.depths = depths, sight.far = farthest;
    sight.samples = lanesOf(cells, depths, lanes, sight.cell, sight.d);
    left &= ~sight.samples;
  }
}

void opaque(const SampleBuffer& samples, size_t pixel, std::vector<Sight>& sights) {
  const size_t lanes = static_cast<size_t>(samples.lanes);
  for (size_t first = 0; first < lanes; first += 64) {
    const size_t here = std::min<size_t>(64, lanes - first);
    const uint32_t* cells = samples.cell.data() + pixel * lanes + first;
    const float* depths = samples.depth.data() + pixel * lanes + first;
    float nearest;
    uint64_t left = ~lanesOf(cells, depths, here, kNoCell, nearest);
    if (here < 64) left &= (uint64_t{1} << here) - 1;
    collect(cells, depths, here, left, static_cast<uint32_t>(first / 64), kInfinity, sights);
  }
}

/// Ranks without a branch that depends on depths: how many are nearer.
int rank(const SampleBuffer& samples, size_t pixel, OpaqueSight* out) {
  const size_t lanes = static_cast<size_t>(samples.lanes), most = std::min<size_t>(hn::Lanes(kF), kMostRanked);
  if (lanes > 64) return -1;
  const uint32_t* cells = samples.cell.data() + pixel * lanes;
  const float* depths = samples.depth.data() + pixel * lanes;
  const auto numbers = hn::Iota(kU, 0);
  OpaqueSight found[kMostRanked];
  Floats all_d = all(kInfinity);
  uint32_t count = 0;
  float unused;
  uint64_t left = ~lanesOf(cells, depths, lanes, kNoCell, unused);
  if (lanes < 64) left &= (uint64_t{1} << lanes) - 1;
  for (; left; ++count) {
    if (count == most) return -1;
    OpaqueSight& s = found[count];
    s.cell = cells[std::countr_zero(left)];
    s.samples = lanesOf(cells, depths, lanes, s.cell, s.d);
    all_d = hn::IfThenElse(hn::RebindMask(kF, hn::Eq(numbers, hn::Set(kU, count))), all(s.d), all_d);
    left &= ~s.samples;
  }
  uint64_t taken = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const size_t nearer = hn::CountTrue(kF, hn::Lt(all_d, all(found[i].d)));
    out[nearer] = found[i];
    taken |= uint64_t{1} << nearer;
  }
  return taken == (uint64_t{1} << count) - 1 ? static_cast<int>(count) : -1;
}

FilmExtent cull(SampleBuffer& samples, const GridTable& grids, size_t index) {
  Films& films = samples.films;
  Film& film = films.film(index);
  const size_t lanes = static_cast<size_t>(samples.lanes), words = films.wordsOfPixel(), word = film.word % words;
  const size_t first = film.word / words * lanes + 64 * word, here = std::min(films.width(), lanes - 64 * word);
  float* depths = films.depths(index);
  uint32_t* cells = films.cells(index);
  Floats nearest = all(kInfinity), farthest = all(-kInfinity);
  for (size_t g = 0; g < here; g += hn::Lanes(kF)) {
    const Floats d = hn::Load(kF, depths + g), before = hn::Load(kF, samples.depth.data() + first + g);
    Mask on = hn::RebindMask(kF, hn::Ne(hn::Load(kU, cells + g), hn::Set(kU, kNoCell)));
    Mask kept = hn::And(on, hn::Le(d, before));
    if (const Mask ties = hn::And(kept, hn::Eq(d, before)); HWY_UNLIKELY(!hn::AllFalse(kF, ties))) {
      uint64_t lost = 0;
      for (uint64_t left = bitsOf(ties); left; left &= left - 1) {
        const auto s = g + static_cast<size_t>(std::countr_zero(left));
        if (!grids.precedes(cells[s], samples.cell[first + s])) lost |= left & (~left + 1);
      }
      kept = hn::AndNot(hn::LoadMaskBits(kF, reinterpret_cast<const uint8_t*>(&lost)), kept);
    }
    nearest = hn::Min(nearest, hn::IfThenElse(kept, d, all(kInfinity)));
    farthest = hn::Max(farthest, hn::IfThenElse(kept, d, all(-kInfinity)));
    if (const uint64_t hidden = bitsOf(hn::AndNot(kept, on)); hidden) {
      film.samples &= ~(hidden << g);
      hn::Store(hn::IfThenElse(hn::RebindMask(kU, kept), hn::Load(kU, cells + g), hn::Set(kU, kNoCell)), kU, cells + g);
    }
  }
  return {hn::GetLane(hn::MinOfLanes(kF, nearest)), hn::GetLane(hn::MaxOfLanes(kF, farthest))};
}

void ofFilm(const Films& films, size_t index, float farthest, std::vector<Sight>& sights) {
  const Film& film = films.film(index);
  const auto word = static_cast<uint32_t>(film.word % films.wordsOfPixel());
  collect(films.cells(index), films.depths(index), films.width(), film.samples, word, farthest, sights);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tomales {
HWY_EXPORT(opaque);
HWY_EXPORT(rank);
HWY_EXPORT(cull);
HWY_EXPORT(ofFilm);
void collectOpaque(const SampleBuffer& samples, size_t pixel, std::vector<Sight>& sights) {
  HWY_DYNAMIC_DISPATCH(opaque)(samples, pixel, sights);
}
int rankOpaque(const SampleBuffer& samples, size_t pixel, OpaqueSight* out) { return HWY_DYNAMIC_DISPATCH(rank)(samples, pixel, out); }
FilmExtent cullFilm(SampleBuffer& samples, const GridTable& grids, size_t film) { return HWY_DYNAMIC_DISPATCH(cull)(samples, grids, film); }
void collectFilm(const Films& films, size_t film, float farthest, std::vector<Sight>& sights) {
  HWY_DYNAMIC_DISPATCH(ofFilm)(films, film, farthest, sights);
}
}  // namespace tomales
#endif

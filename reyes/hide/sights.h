// Which cells the samples of a pixel see: lists of lanes become one Sight a cell. Private to the hider.
#pragma once
#include <span>

#include "reyes/hide/pixel_layers.h"
#include "reyes/hide/samples.h"

namespace tomales {

/// Appends what the samples of a pixel see of opaque surfaces.
void collectOpaque(const SampleBuffer& samples, size_t pixel, std::vector<Sight>& sights);

/// A Sight that is alone at its samples, among the first 64 of a word.
struct RankedSight {
  uint64_t samples;
  uint32_t cell;
  float d;
};
constexpr int kMostRanked = kLanes;
/// Nearest first. count: less than 0 if samples see more than are looked at here, or some at equal depths.
struct RankedSights {
  int count;
  RankedSight sights[kMostRanked];
};
constexpr size_t kRankedTogether = 32;
/// What the samples of some pixels see of opaque surfaces. Pre: no more than kRankedTogether.
void rankOpaque(const SampleBuffer& samples, std::span<const uint32_t> pixels, RankedSights* out);
/// What those of a pixel see of a film.
void rankFilm(const Films& films, size_t film, RankedSights& out);

/// What is left of a film: the depth keys between which it lies.
struct FilmExtent {
  float nearest, farthest;
};
/// Takes away from a film what opaque surfaces hide. Pre: it covers something; afterwards it may cover nothing.
FilmExtent cullFilm(SampleBuffer& samples, const GridTable& grids, size_t film);
/// Appends what the samples see of a film. farthest: of its depth keys.
void collectFilm(const Films& films, size_t film, float farthest, std::vector<Sight>& sights);

}  // namespace tomales

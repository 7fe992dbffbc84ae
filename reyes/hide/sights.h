// Which cells the samples of a pixel see: lists of lanes become one Sight a cell. Private to the hider.
#pragma once
#include "reyes/hide/pixel_layers.h"
#include "reyes/hide/samples.h"

namespace tomales {

/// Appends what the samples of a pixel see of opaque surfaces.
void collectOpaque(const SampleBuffer& samples, size_t pixel, std::vector<Sight>& sights);

/// A Sight of an opaque surface among the first 64 samples.
struct OpaqueSight {
  uint64_t samples;
  uint32_t cell;
  float d;
};
constexpr int kMostRanked = kLanes;
/// What the samples of a pixel see of opaque surfaces, nearest first, and how many that is. Less than 0: they see more than are looked at here,
/// or some at equal depths.
int rankOpaque(const SampleBuffer& samples, size_t pixel, OpaqueSight out[kMostRanked]);

/// What is left of a film: the depth keys between which it lies.
struct FilmExtent {
  float nearest, farthest;
};
/// Takes away from a film what opaque surfaces hide. Pre: it covers something; afterwards it may cover nothing.
FilmExtent cullFilm(SampleBuffer& samples, const GridTable& grids, size_t film);
/// Appends what the samples see of a film. farthest: of its depth keys.
void collectFilm(const Films& films, size_t film, float farthest, std::vector<Sight>& sights);

}  // namespace tomales

// The uses of random numbers, by name: each use mixes its name into the hash that names its numbers (rng.h), so that
// uses that share all other names are independent. Two names with the same bits do not compile.
#pragma once
#include <cstdint>
#include <string_view>

namespace tomales {

struct RandomStream {
  std::string_view name;
  const char* what;
  uint32_t bits = ofLetters(name);

  /// Packs four letters, the first into the highest byte.
  static constexpr uint32_t ofLetters(std::string_view letters) {
    uint32_t out = 0;
    for (const char c : letters) out = out << 8 | static_cast<unsigned char>(c);
    return out;
  }
};

inline constexpr RandomStream kRandomStreams[] = {
    {"patt", "places, times and lens points of a pixel's samples"},
    {"proc", "names of procedurals, as objects have them"},
    {"time", "times of the rays of a point"},
    {"trac", "points that rays of shaders meet"},
    {"cone", "directions of gather() and trace() in a cone"},
    {"base", "starts of rays around a point"},
    {"envi", "directions of environment() by rays"},
    {"lobe", "directions of a reflection's lobe"},
    {"path", "directions of the reference path tracer"},
    {"refl", "paths of the reference path tracer along a reflection's lobe"},
    {"goes", "which paths along a lobe go on after the first surface"},
    {"laye", "points that rays meet behind what they pass"},
    {"height", "which height in its cell each column of a hemisphere takes", 0x51633e2d},
    {"angle", "which angle in its cell each ring of a hemisphere takes", 0x68bc21eb},
    {"in height", "places within the height of a hemisphere's cell", 0x3c6ef372},
    {"in angle", "places within the angle of a hemisphere's cell", 0xa54ff53a},
    {"second", "the second coordinate of a pair whose name gives the first", 0x9e3779b9},
    {"fine", "directions in cells that are divided"},
    {"prob", "directions that find what hides a bright spot"},
    {"spot", "bright spots that rays are aimed at"},
    {"aims", "directions towards bright spots"},
    {"shee", "directions that look for thin sheets"},
    {"boun", "levels at which records of further bounces begin; bounces of photons, whose other names differ"},
    {"hits", "points that see where records of further bounces go"},
    {"more", "points that see where records of further bounces go, from those records on"},
    {"radi", "places in texels of radiosity maps"},
    {"port", "places in portals of a sky"},
    {"lamp", "lamps that are drawn from many"},
    {"aspe", "directions through portals of a sky"},
    {"phot", "the second pair of numbers of a photon's start"},
    {"medi", "collisions of photons in media"},
    {"volu", "rays that cross a Volume, by turns"},
    {"pass", "passes of photons that are counted at points"},
    {"audi", "pixels that are audited"},
    {"sets", "light that an audit finds at its pixels, set by set"},
    {"glos", "light by which an audit finds the pixels that see highlights of indirect light"},
    {"bloc", "blocks of pixels that an audit looks at for smudges"},
    {"cell", "pixels of a block that an audit looks at"},
    {"even", "light that an audit finds in blocks, set by set"},
    {"targ", "buckets of trials, and the audits of one frame"},
    {"boot", "pixels that are drawn again to know how certain an audit is"},
    {"resa", "blocks that are drawn again to know how certain an audit is"},
    {"anew", "light of the draw that shows a pixel's standard error"},
    {"reca", "noise of a record in the draw that shows standard errors"},
    {"alon", "rays of points without records in the draw that shows standard errors"},
    {"open", "directions that look for openings to the sky"},
    {"from", "places that look through an opening to the sky"},
    {"pane", "where such places look through an opening"},
};

consteval bool randomStreamsDiffer() {
  for (const RandomStream& a : kRandomStreams)
    for (const RandomStream& b : kRandomStreams)
      if (&a != &b && (a.bits == b.bits || a.name == b.name)) return false;
  return true;
}
static_assert(randomStreamsDiffer());

/// Returns the bits of a name of the table; other names do not compile.
consteval uint32_t randomStream(std::string_view name) {
  for (const RandomStream& s : kRandomStreams)
    if (s.name == name) return s.bits;
  throw "a random stream that the table does not have";
}

}  // namespace tomales

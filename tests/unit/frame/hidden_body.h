// Bodies in front of nothing, hidden: which samples see something.
#pragma once
#include <gtest/gtest.h>

#include <bit>

#include "reyes/frame.h"
#include "reyes/prim_factories.h"
#include "reyes/rib.h"
#include "reyes/shader_registry.h"

extern const TmShaderLibrary* tomales_builtin_shaders(void);

namespace tomales::test {

constexpr const char* kSphere = "Sphere 1 -1 1 360";

// Sides 1: else what shows through a crack is the far side of the body, not the background.
constexpr const char* kSeenAskew = "Sides 1 Translate 0 0 3.2 Rotate 25 1 0.3 0.1 ";

/// Every message of the log fails the test.
inline DeepFrame hideRib(const std::string& rib) {
  Log log(Log::Verbosity::Quiet);
  Stats stats;
  std::vector<Scene> scenes;
  RibSettings settings;
  settings.onScene = [&](Scene&& s) { scenes.push_back(std::move(s)); };
  readRibText(rib, "body.rib", settings, log);
  ShaderRegistry registry(log);
  registry.addLibrary(tomales_builtin_shaders(), "built-in");
  ShadingSystem shading(scenes.at(0), registry, nullptr, log, stats);
  DeepFrame frame = hideFrame(scenes[0], shading, {}, stats, log);
  for (const LogEntry& e : log.entries()) ADD_FAILURE() << e.code << ": " << e.message;
  return frame;
}

inline DeepFrame hide(const std::string& body, const std::string& options = {},
                      const std::string& placed = kSeenAskew) {
  return hideRib(
      "Format 128 128 1 PixelSamples 6 6 PixelFilter \"box\" 1 1 Projection \"perspective\" \"fov\" 40 "
      "Clipping 0.1 100 " +
      options + " " + placed + "WorldBegin " + body + " WorldEnd");
}

/// Calls f(tile, fragment) for the fragments of a pixel, nearest first.
template <class F>
void forFragments(const DeepFrame& frame, int x, int y, const F& f) {
  const DeepTile& tile = frame.tileAt(x, y);
  const DeepPixel& p = tile.pixel(x, y);
  for (uint32_t k = 0; k < p.count; ++k) f(tile, tile.fragments[p.first + k]);
}

/// Samples of a pixel that see something, those that see through it counted again for each further surface.
inline int covered(const DeepFrame& frame, int x, int y) {
  int n = 0;
  forFragments(frame, x, y, [&](const DeepTile&, const Fragment& f) { n += std::popcount(f.samples); });
  return n;
}

struct Holes {
  int inside_px = 0, samples = 0;
};

/// A pixel lies inside the silhouette if all within `margin` pixels of it are at least half covered: where
/// blur spreads the silhouette by that much to either side, coverage is whole again.
inline Holes holes(const DeepFrame& frame, int margin = 2) {
  const PixelRect& r = frame.crop;
  const int width = r.x1 - r.x0;
  std::vector<int> samples;
  for (int y = r.y0; y < r.y1; ++y)
    for (int x = r.x0; x < r.x1; ++x) samples.push_back(covered(frame, x, y));
  const auto seen = [&](int x, int y) { return samples[static_cast<size_t>((y - r.y0) * width + x - r.x0)]; };
  const auto inside = [&](int x, int y) {
    for (int dy = -margin; dy <= margin; ++dy)
      for (int dx = -margin; dx <= margin; ++dx)
        if (2 * seen(x + dx, y + dy) < frame.samplesPerPixel) return false;
    return true;
  };
  Holes found;
  for (int y = r.y0 + margin; y < r.y1 - margin; ++y)
    for (int x = r.x0 + margin; x < r.x1 - margin; ++x)
      if (inside(x, y)) {
        ++found.inside_px;
        found.samples += frame.samplesPerPixel - seen(x, y);
      }
  return found;
}

}  // namespace tomales::test

#include "raytrace/motion_keys.h"

namespace tomales {
namespace {

/// With this many parts of the shutter, no key is farther than a 64th of it from the end of a part.
constexpr int kMostSteps = 32;
constexpr float kSameTime = 1.0f / 512;  ///< Share of the shutter.

/// Returns the motion keys inside the shutter, as shares of it. Empty if the object stands still.
std::vector<float> keysOf(const Object& o, const Options& options) {
  std::vector<float> keys;
  const auto add = [&](const std::vector<float>& times) {
    for (const float t : times)
      keys.push_back((t - options.shutterOpen) / (options.shutterClose - options.shutterOpen));
  };
  if (o.attributes->areaLight >= 0) return keys;
  if (o.currentFromObject.moving()) add(o.currentFromObject.times);
  if (o.shapes.size() > 1) add(o.shapeTimes);
  const bool moves = !keys.empty() && *std::min_element(keys.begin(), keys.end()) < 1 &&
                     *std::max_element(keys.begin(), keys.end()) > 0;
  if (!moves) return {};
  std::erase_if(keys, [](float k) { return !(k > 0 && k < 1); });
  keys.push_back(1);
  return keys;
}

int stepsFor(const std::vector<float>& keys) {
  if (keys.empty()) return 0;
  const auto meets = [&](int steps) {
    return std::all_of(keys.begin(), keys.end(), [&](float k) {
      const float at = k * static_cast<float>(steps);
      return std::abs(at - std::round(at)) < kSameTime * static_cast<float>(steps);
    });
  };
  int steps = 1;
  while (steps < kMostSteps && !meets(steps)) ++steps;
  return steps;
}

}  // namespace

bool raysHaveTimes(const Scene& scene) {
  return scene.options.shutterIsOpen() &&
         std::any_of(scene.groups.begin(), scene.groups.end(),
                     [](const ShadeGroup& g) { return g.attributes->trace.sampleMotion; });
}

std::vector<std::vector<float>> motionKeyTimes(const Scene& scene) {
  std::vector<std::vector<float>> keys(scene.groups.size());
  if (raysHaveTimes(scene))
    for (const Object& o : scene.objects) {
      const std::vector<float> own = keysOf(o, scene.options);
      auto& group = keys[static_cast<size_t>(o.group)];
      group.insert(group.end(), own.begin(), own.end());
    }
  std::vector<std::vector<float>> times;
  for (const auto& k : keys) {
    const int steps = stepsFor(k);
    auto& out = times.emplace_back(1, scene.options.shutterOpen);
    for (int i = 1; i <= steps; ++i)
      out.push_back(lerp(scene.options.shutterOpen, scene.options.shutterClose,
                         static_cast<float>(i) / static_cast<float>(steps)));
  }
  return times;
}

}  // namespace tomales

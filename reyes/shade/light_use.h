// Finds out where the light of each lamp goes: whether it reaches anything that the camera sees, and whether it is far
// too bright for a picture.
#pragma once
#include <array>
#include <atomic>
#include <deque>
#include <mutex>
#include <optional>
#include <set>

#include "reyes/shade.h"

namespace tomales {

class Batch;
struct BoundGroup;
struct BoundLight;
struct BoundScene;
struct LightSample;

/// Any thread may add; the result does not depend on the order.
class LightUse {
 public:
  /// `lights` is the number of lights of the scene.
  explicit LightUse(size_t lights) : uses_(lights) {}
  /// Counts the light samples that a surface shader has asked for at the points of a batch.
  void add(const Batch& batch);
  /// Reports surfaces that ask for light where there is none, lights that reach nothing, and a light that alone makes
  /// most of the picture too bright.
  void warn(const BoundScene& scene) const;

 private:
  static constexpr int kStops = 32;
  struct Use {
    std::atomic<bool> asked{false};   ///< Some surface has asked for its light.
    std::atomic<bool> bright{false};  ///< Its shader sends light to some point.
    std::atomic<bool> faces{false};   ///< Some such point faces it.
    std::atomic<bool> comes{false};   ///< Some point that faces it is not in its shadow.
    /// Number of points that it makes 2^k to 2^(k+1) times as bright as white, indexed by k.
    std::array<std::atomic<int64_t>, kStops> stops{};
  };
  void follow(const Batch& batch, const LightSample& sample, Use& use);
  void countStops(const Batch& batch);
  void warnOfDarkness(const BoundScene& scene) const;
  void warnOfUseless(const BoundScene& scene) const;
  void warnOfGlare(const BoundScene& scene) const;
  std::string whyUseless(const BoundScene& scene, const Use& use, size_t index) const;

  std::deque<Use> uses_;
  std::atomic<int64_t> points_{0};  ///< The number of points whose stops were counted.
  mutable std::mutex mutex_;        ///< It guards what follows.
  std::set<const BoundGroup*> unlit_;
  std::map<size_t, vec3> places_;  ///< Positions of lights, in current space.
};

}  // namespace tomales

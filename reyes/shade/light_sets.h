// Sets of lights of which a point draws a few instead of running all (Option "trace" "lightcut"). The lights of a set
// differ in numbers alone, so the lights that points draw run as one light whose parameters vary from point to point.
// Threads: any.
#pragma once
#include <memory>
#include <mutex>
#include <vector>

#include "reyes/light_list.h"
#include "reyes/shade/light_tree.h"
#include "reyes/shader_api.h"

namespace tomales {

struct BoundLight;
struct BoundScene;

/// A set has more lights than this many times the number that a point draws; fewer lights all run. The second number
/// holds for lights without shadows: a drawn light takes as long as three that cast shadows, or thirty that do not
/// (docs/measured/rays.md).
constexpr size_t kFewLights = 4, kFewWithoutShadows = 32;

struct LightSet {
  std::vector<const BoundLight*> lights;  ///< Indexed as the tree's lamps.
  std::vector<int> varying;               ///< The parameters whose values differ.
  /// All numbers of these parameters, lamp by lamp, so that a lamp's numbers are adjacent.
  std::vector<float> numbers;
  LightTree tree;
};

/// Sets that also serve every list of lights that is a beginning of theirs.
struct SharedSets {
  std::vector<LightSet> sets;
  std::vector<int> setOf;  ///< The set of each light of the scene; -1 if there is none.
};

/// The first lights of a set.
struct LightsOfSet {
  const LightSet* set;
  uint32_t count;
};

struct LightSets {
  LightList alone;  ///< Lights that run at every point.
  std::vector<LightsOfSet> sets;
};

/// The sets of the lights of some groups of objects. They are made when light is first asked for, because the places of
/// lamps with geometry are known by then.
class LightChoice {
 public:
  /// `longest`: the choice for a longer list that begins with these lights, whose sets this one shares; null if it has
  /// its own.
  explicit LightChoice(LightList lights, std::shared_ptr<const LightChoice> longest = nullptr)
      : lights_(std::move(lights)), longest_(std::move(longest)) {}
  const LightList& lights() const { return lights_; }
  /// Returns null if all lights run.
  const LightSets* sets(const BoundScene& scene) const;

 private:
  const SharedSets& shared(const BoundScene& scene) const;

  const LightList lights_;
  const std::shared_ptr<const LightChoice> longest_;
  mutable std::once_flag made_, chosen_;
  mutable SharedSets shared_;
  mutable std::unique_ptr<const LightSets> sets_;
};

}  // namespace tomales

// What has become of the lights of a frame since irradiance records were gathered under them.
#pragma once
#include "gi/icf.h"

namespace tomales {

struct LightEdits {
  /// The gain of each of IrradianceShot::groups (GiServices::mixShares); empty if all are 1 or there are no shares.
  std::vector<vec3> gains;
  /// Handles of changed lights whose bounced light does not follow: the records have no shares, or the change is no
  /// factor on intensity and colour, or differs from that of another light of the group.
  std::vector<std::string> stale;
};

/// builtIn: the standard lights are those of the program, whose light is in proportion to "intensity" and "lightcolor".
/// The light of other shaders may follow these numbers in any way.
LightEdits editsSince(const IrradianceShot& gathered, const Scene& now, const ShadingSystem& shading, bool builtIn);

/// Tells whether what this built-in light sends is in proportion to its "intensity" and "lightcolor".
bool shinesInProportion(const std::string& shader);

/// The groups of lights that bounce, for GiServices::keepShares: empty first, then by name.
std::vector<std::string> groupsOfLights(const Scene& scene, const ShadingSystem& shading);

}  // namespace tomales

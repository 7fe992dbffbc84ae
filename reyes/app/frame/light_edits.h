// The changes of the lights of a frame since irradiance records were gathered under them.
#pragma once
#include "gi/icf.h"

namespace tomales {

struct LightEdits {
  /// The gain of each of IrradianceShot::groups (GiServices::mixShares); empty if all are 1 or there are no shares.
  /// *Example:* a light that is moved and made half as bright bounces half of what it bounced from its old place.
  std::vector<vec3> gains;
  /// Handles of changed lights whose bounced light does not follow the edit. That is so if the records have no shares,
  /// if more is changed than parameters that are factors (isFactor()), or if the gain differs from that of another
  /// light of the group.
  std::vector<std::string> stale;
};

/// Compares the lights by which records were gathered with the lights of the scene now. If these are not the same
/// lights, it is another scene, and nothing is known of edits.
LightEdits editsSince(const IrradianceShot& gathered, const Scene& now, const ShadingSystem& shading);

/// Returns the groups of lights that bounce, for GiServices::keepShares: empty first, then by name.
std::vector<std::string> groupsOfLights(const Scene& scene, const ShadingSystem& shading);

}  // namespace tomales

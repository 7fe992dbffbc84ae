// Light that diffuses under the surface of a translucent material: the dipole of Jensen, Marschner, Levoy, Hanrahan
// 2001 ("A practical model for subsurface light transport"), and its inverse for artists of Jensen, Buhler 2002 ("A
// rapid hierarchical rendering technique for translucent materials"). Lengths in millimetres. Private to gi.
#pragma once
#include <optional>
#include <string_view>

#include "reyes/base/math.h"

namespace tomales {

struct Translucency {
  vec3 scattering, absorption;  ///< Reduced scattering and absorption, 1/mm.
  float ior;
};

/// Measured ones, by name (Jensen et al. 2001, figure 5).
std::optional<Translucency> translucencyOf(std::string_view material);
/// That which reflects `albedo` of diffuse light, and lets it go `meanFreePath` mm far.
Translucency translucencyOf(const vec3& albedo, const vec3& meanFreePath, float ior);

class Dipole {
 public:
  explicit Dipole(const Translucency& material);
  /// Radiant exitance per incident flux at so many mm2 of squared distance, 1/mm2: Rd of equation 4.
  vec3 exitance(float distance2) const;
  /// Its integral over a plane: the share of light that comes back.
  vec3 reflectance() const;

 private:
  vec3 albedo_, decay_, real_, virtual_;  ///< Of one scattering; sigma_tr; depth and height of the two sources.
};

}  // namespace tomales

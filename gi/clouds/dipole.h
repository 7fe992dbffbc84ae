// Private to gi: light that diffuses under the surface of a translucent material. Sources: the dipole of Jensen,
// Marschner, Levoy, Hanrahan 2001 ("A practical model for subsurface light transport"), and the inverse of it by Jensen
// and Buhler 2002 ("A rapid hierarchical rendering technique for translucent materials"). Lengths are in millimetres.
#pragma once
#include <optional>
#include <string_view>

#include "reyes/base/math.h"

namespace tomales {

struct Translucency {
  vec3 scattering, absorption;  ///< Coefficients of reduced scattering and of absorption, 1/mm.
  float ior;
};

/// Returns measured coefficients by name (Jensen et al. 2001, figure 5); empty if there is no such material.
std::optional<Translucency> translucencyOf(std::string_view material);
/// Returns the material with this diffuse albedo and this diffuse mean free path (1 / sigma_tr) in mm.
Translucency translucencyOf(const vec3& albedo, const vec3& meanFreePath, float ior);

class Dipole {
 public:
  explicit Dipole(const Translucency& material);
  /// Returns radiant exitance per incident flux at a squared distance in mm2, in 1/mm2: Rd of equation 4.
  vec3 exitance(float distance2) const;
  /// Returns the integral of exitance() over a plane: the share of light that comes back.
  vec3 reflectance() const;

 private:
  /// The albedo of single scattering; sigma_tr in 1/mm; depth and height of the real and the virtual source in mm.
  vec3 albedo_, decay_, real_, virtual_;
};

}  // namespace tomales

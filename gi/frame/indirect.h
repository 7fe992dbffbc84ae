// Private to gi: indirectDiffuse() from irradiance caches. Space: current. Irradiance: E/pi.
#pragma once
#include "gi/frame/state.h"

namespace tomales {

/// Writes E/pi and dominant directions to element i of a result.
void setIndirect(const IndirectResult& out, int i, const vec3& E, const vec3 dominant[3]);

/// Answers the points that the eye sees. Pre: the light may still bounce there.
void interpolateIndirect(const GiState&, const AskedPoints&, const IndirectQuery&, const ShadeContext&,
                         const IndirectResult& out);
/// Answers the hits of gather rays: from the caches of further bounces, or traced. Pre: the same.
void bounceIndirect(const GiState&, const AskedPoints&, const IndirectQuery&, const ShadeContext&, int bounces,
                    const IndirectResult& out);

}  // namespace tomales

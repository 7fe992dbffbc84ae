// Private to gi: shadow rays towards lights. Space: current.
#pragma once
#include "gi/frame/state.h"

namespace tomales {

/// Implements ShadeServices::transmission().
void traceShadows(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 toward, const ShadowRays&,
                  const ShadeContext&, TmVec3 light);

}  // namespace tomales

// Private to gi: what a gather pass has learnt of the light besides its records. Points that no record serves gather by
// it, and what their rays and those of mirrors meet is lit by it. Space: current. Irradiance: E/pi.
#pragma once
#include "gi/cache/bright_spots.h"
#include "gi/frame/bounce_caches.h"

namespace tomales {

struct LearntLight {
  BrightSpots spots;  ///< Some rays are aimed at these.
  BounceCaches bounces;
};

}  // namespace tomales

// Private to gi: what a gather pass has learnt of the light besides its records. It guides the rays of points that no
// record serves, and it lights what these rays and mirror rays hit. Space: current. Irradiance: E/pi.
#pragma once
#include "gi/cache/bright_spots.h"
#include "gi/frame/bounce_caches.h"

namespace tomales {

struct LearntLight {
  BrightSpots spots;  ///< Some rays are aimed at these.
  BounceCaches bounces;
};

}  // namespace tomales

// Private to gi: origins and times of rays that leave points which may move. Space: current. Times: shares of the
// shutter.
#pragma once
#include "gi/frame/state.h"

namespace tomales {

/// Returns the time of ray `number` of the `count` that leave a point: the point's own time, or a stratified one if the
/// point is seen over the whole shutter and its object samples motion. Successive points of one SampleName continue
/// each other's sequence.
float rayTime(const RayScene&, const ShadePoints&, int i, int number, int count, uint32_t seed);

/// Moves the start of a ray to where the point is at that time, keeping its end if it has one, and prepares it.
void startRay(const RayScene&, const ShadePoints&, int i, float time, Ray&);

}  // namespace tomales

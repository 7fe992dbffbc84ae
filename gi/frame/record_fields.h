// Private to gi: the fields that files keep of a record, of the light that its rays found, and of its point. Space and
// units: those of these structures.
#pragma once
#include "gi/gather.h"
#include "reyes/base/pack.h"

namespace tomales {

template <class A>
void fields(A& a, IrradianceExpansion& x) {
  auto& [E, rotation, translation, hessian] = x;
  each(a, E, rotation, translation, hessian);
}

template <class A>
void fields(A& a, IrradianceRecord& x) {
  auto& [position, normal, light, tangent, dominant, harmonicMean, closest, smoothRadius, noise, limit, pixelSize,
         unseenDisplacement, shares] = x;
  auto& [E, rotation, translation, hessian] = light;
  each(a, position, normal, E, rotation, translation, tangent, hessian, dominant, harmonicMean, closest, smoothRadius,
       noise, limit, pixelSize, unseenDisplacement, shares);
}

template <class A>
void fields(A& a, BrightHit& x) {
  auto& [position, radiance, normal] = x;
  each(a, position, radiance, normal);
}

template <class A>
void fields(A& a, BrightFind& x) {
  auto& [irradiance, hits] = x;
  each(a, irradiance, hits);
}

template <class A>
void fields(A& a, GatherPoint& x) {
  auto& [group, position, normal, key, pixelSize, edgeLength, drift, time] = x;
  each(a, group, position, normal, key, pixelSize, edgeLength, drift, time);
}

}  // namespace tomales

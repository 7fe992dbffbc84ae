// The answers of a ShadeServices that lacks these services.
#include "reyes/shade_services.h"

namespace tomales {

bool ShadeServices::interpolatedHemisphere(const ShadePoints&, const uint8_t*, TmConstVec3, const HemisphereQuery&,
                                           const ShadeContext&, TmVec3) const {
  return false;
}

void ShadeServices::indirectAlong(const ShadePoints& points, const uint8_t* active, const LobeDirection&,
                                  const IndirectQuery&, const ShadeContext&, TmVec3 out) const {
  for (int i = 0; i < points.count(); ++i)
    if (active[i]) set(out, i, vec3(0.0f));
}

bool ShadeServices::volumesBefore(const ShadePoints&, const ShadeContext&, ShadedPoints&) const { return false; }

void ShadeServices::storedIrradiance(const ShadePoints& points, const uint8_t* active, TmVec3 E) const {
  for (int i = 0; i < points.count(); ++i)
    if (active[i]) set(E, i, vec3(0.0f));
}

bool ShadeServices::sampleWholeEmitter(int, int, TmConstVec3, const float*, const float*, const EmitterPoints&) const {
  return false;
}

void ShadeServices::meetWholeEmitter(int, int, int count, TmConstVec3, TmConstVec3, const EmitterPoints& out) const {
  std::fill_n(out.pdf, count, 0.0f);
}

Bound3 ShadeServices::emitterBound(int) const { return {}; }

}  // namespace tomales

// An implementation of the interface to rays that knows nothing: rays meet nothing, and there are no lamps.
#pragma once
#include "reyes/shade_services.h"

namespace tomales::test {

class BareServices : public ShadeServices {
 public:
  void transmission(const ShadePoints&, const uint8_t*, TmConstVec3, const ShadowRays&, const ShadeContext&,
                    TmVec3) const override {}
  void trace(const ShadePoints&, const uint8_t*, TmConstVec3, TmConstVec3, const RayQuery&, const ShadeContext&,
             const RayResult&) const override {}
  bool sampleEmitter(int, int, TmConstVec3, const float*, const float*, const EmitterPoints&) const override {
    return false;
  }
  void meetEmitter(int, int, TmConstVec3, TmConstVec3, const EmitterPoints&) const override {}
  float emitterReach(int) const override { return 0; }
  float emitterArea(int) const override { return 0; }
  void indirectDiffuse(const ShadePoints&, const uint8_t*, TmConstVec3, const IndirectQuery&, const ShadeContext&,
                       IndirectResult) const override {}
};

}  // namespace tomales::test

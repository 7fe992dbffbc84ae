// The ray-traced calls behind TmServices: sums here, cones in ray_shots.h, rays behind ShadeServices.
#pragma once
#include <initializer_list>
#include <string_view>

#include "reyes/shade/primary.h"

namespace tomales {

/// What is known of the rays of a call of gather() under a name; of numbers x alone.
struct RayValue {
  std::string_view name;
  TmConstVec3 value;
};
/// Fills in the outputs of these names, and lets neighbours have all outputs.
void setRayOutputs(const Primary& primary, const TmRayOutput* outputs, int32_t outputCount,
                   std::initializer_list<RayValue> known);

void traceRays(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 direction, const TmRayOptions*, TmVec3 color,
               float* distance);
int32_t gatherRays(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 axis, const TmRayOptions*, int32_t ray,
                   uint8_t* hit, const TmRayOutput* outputs, int32_t outputCount);
/// Both in hemisphere_services.cpp.
int32_t hemisphere(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 N, const TmRayOptions*,
                   const TmHemisphere* out);
void occlusion(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 N, const TmRayOptions*, float* covered,
               TmVec3 radiance);
void transmissionWith(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 toward, const TmRayOptions*, TmVec3 out);
int32_t rayInfo(void* host, const TmGrid*, const char* name, TmVec3 out);
const char* rayLabel(void* host, const TmGrid*);

}  // namespace tomales

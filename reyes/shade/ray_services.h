// What a ray of gather() tells. Behind TmServices::gather.
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
void setRayOutputs(const Primary& primary, const TmChannel* outputs, int32_t outputCount,
                   std::initializer_list<RayValue> known);

}  // namespace tomales

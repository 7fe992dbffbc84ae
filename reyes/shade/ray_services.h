// The values that a ray of gather() returns. Used by TmServices::gather.
#pragma once
#include <initializer_list>
#include <string_view>

#include "reyes/shade/primary.h"

namespace tomales {

/// A value of the rays of a call of gather(), by its name. A number is in x alone.
struct RayValue {
  std::string_view name;
  TmConstVec3 value;
};
/// Sets the outputs that have these names, and copies all outputs to the neighbours.
void setRayOutputs(const Primary& primary, const TmChannel* outputs, int32_t outputCount,
                   std::initializer_list<RayValue> known);

}  // namespace tomales

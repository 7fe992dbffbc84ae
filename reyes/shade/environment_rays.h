// gather("environment:NAME"): samples the light of a picture instead of tracing rays.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

/// TmServices::gather for options that name an environment. Directions are drawn from the whole sphere, half of them by
/// the brightness of the picture and half evenly. The sum of "environment:color" times "environment:solidangle" over
/// all samples is the light of the whole picture. No ray is traced.
int32_t gatherEnvironment(Batch& batch, const TmGrid* all, TmConstVec3 P, const TmRayOptions& options, int32_t ray,
                          uint8_t* hit, const TmChannel* outputs, int32_t outputCount);

}  // namespace tomales

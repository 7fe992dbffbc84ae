// Looks pictures up by direction, for shaders and for the rays that they shoot.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

/// Implements TmServices::environment.
int32_t environment(void* host, const TmGrid*, const char* name, const TmTextureOptions*, TmConstVec3 direction,
                    TmVec3 out);

}  // namespace tomales

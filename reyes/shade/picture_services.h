// Looks up pictures by direction, for shaders and for their rays.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

/// Implements TmServices::environment.
int32_t environment(void* host, const TmGrid*, const char* name, const TmTextureOptions*, TmConstVec3 direction,
                    TmVec3 out);

}  // namespace tomales

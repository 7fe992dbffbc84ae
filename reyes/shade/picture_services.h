// The calls behind TmServices that look pictures up.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

int32_t texture(void* host, const TmGrid*, const char* name, int32_t channel, int32_t channels, const float* s,
                const float* t, TmVec3 out);
int32_t textureOver(void* host, const TmGrid*, const char* name, const TmTextureLookup* lookup, const float* s,
                    const float* t, const float* const* sides, TmVec3 out);
int32_t textureWith(void* host, const TmGrid*, const char* name, const TmTextureLookup*, const float* s, const float* t,
                    TmVec3 out);
int32_t environment(void* host, const TmGrid*, const char* name, TmConstVec3 direction, const float* width, TmVec3 out);
int32_t environmentWith(void* host, const TmGrid*, const char* name, const TmTextureLookup*, TmConstVec3 direction,
                        TmVec3 out);
int32_t textureInfo(void* host, const TmGrid*, const char* name, const char* what, int32_t* type, TmValue* out);

}  // namespace tomales

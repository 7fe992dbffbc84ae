// Point clouds and brick maps behind TmServices: from current space to that of the file and back.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

int32_t bake3d(void* host, const TmGrid*, const char* file, TmConstVec3 P, TmConstVec3 N, const TmCloudLookup*,
               const TmCloudValue* values, int32_t valueCount);
int32_t texture3d(void* host, const TmGrid*, const char* file, TmConstVec3 P, TmConstVec3 N, const TmCloudLookup*,
                  const TmCloudValue* values, int32_t valueCount, float* found);
int32_t photonMap(void* host, const TmGrid*, const char* file, TmConstVec3 P, TmConstVec3 N, int32_t estimator,
                  TmVec3 out);
int32_t photonMapWith(void* host, const TmGrid*, const char* file, TmConstVec3 P, TmConstVec3 N, const TmPhotonLookup*,
                      TmVec3 out);
/// Of occlusion(), without neighbours.
bool occlusionByDisks(Batch&, const TmGrid*, const char* file, TmConstVec3 P, TmConstVec3 N, const DisksQuery&,
                      float* covered, TmVec3 radiance);
int32_t subsurface(void* host, const TmGrid*, const char* file, TmConstVec3 P, const TmSubsurface*, TmVec3 out);

}  // namespace tomales

// Glossy surfaces under lights that have an extent. A highlight is a sum over samples of the light and over samples of
// the surface's own lobe, weighted by the power heuristic (Veach and Guibas 1995, "Optimally Combining Sampling
// Techniques for Monte Carlo Rendering"): small lights are found by their own samples, narrow lobes by theirs. Behind
// TmServices.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

void specular(void* host, const TmGrid*, TmConstVec3 N, TmConstVec3 V, const float* roughness, TmVec3 out);
void lightDensity(void* host, const TmGrid*, int32_t index, float* out);
void lightAlong(void* host, const TmGrid*, TmConstVec3 L, const float* density, int32_t sample, int32_t samples,
                TmVec3 Cl);
int32_t lobeSamples(void* host, const TmGrid*);
void stratified(void* host, const TmGrid*, int32_t sample, int32_t samples, float* xi0, float* xi1);

}  // namespace tomales

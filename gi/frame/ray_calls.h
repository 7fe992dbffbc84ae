// Private to gi: rays that shaders trace. Space: current.
#pragma once
#include "gi/frame/state.h"

namespace tomales {

/// Returns the filter for rays that a shader of an object with these attributes traces.
RayFilter filterOf(const RayScene&, const RayQuery&, const Attributes&);
/// Replaces the hit list by the bias, if the shader gives one.
void setBias(const RayQuery&, Ray&);

/// Returns the context of the points that a shader's rays meet: their depths and limits. None if no ray is traced.
std::optional<ShadeContext> contextOfHits(const GiState&, const ShadePoints&, const RayQuery&, const ShadeContext&);

/// Implements ShadeServices::trace().
void traceForShader(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 P, TmConstVec3 direction,
                    const RayQuery&, const ShadeContext&, const RayResult&);

/// Implements ShadeServices::volumesBefore().
bool crossVolumesBefore(const GiState&, const ShadePoints&, const ShadeContext&, ShadedPoints& out);

}  // namespace tomales

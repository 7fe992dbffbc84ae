// Decides which lights run at a batch of points, and makes the grid that a light shader gets there. The files of Lights
// share it.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

inline bool bringsLights(Illumination light) {
  return light == Illumination::Lights || light == Illumination::LightsAndStored;
}
inline bool bringsStored(Illumination light) {
  return light == Illumination::Stored || light == Illumination::LightsAndStored;
}

/// Tells whether the light counts for rays of the batch's kind.
bool isOn(const BoundLight& light, const Batch& batch);
/// Tells whether the light counts and the scene's lights light the batch at all. They do not while displacing, for
/// shadow rays, and where stored or unit light replaces lights.
bool applies(const BoundLight& light, const Batch& batch);

/// Returns the grid of the points for a light shader, without neighbours; its results have room for those.
TmGrid lightGrid(Batch& batch, const BoundLight& light);
/// Makes room for the outputs of a light, so that lightsource() can read them.
void openOutputs(Batch& batch, const BoundShader& light, std::vector<TmValue>& params);
/// Sets light that is not finite to 0, with a report: the fault is the light's, not the asking surface's.
void darkenNonFinite(Batch& batch, const BoundShader& light, const TmGrid& g);

/// Returns the random numbers of sample `sample` of `samples` of a light at a point. They follow from the point's name,
/// never from its place in the batch.
vec2 sampleAt(const Batch& batch, const BoundLight& light, int i, int sample, int samples);
int samplesOf(const BoundLight& light, const Batch& batch);

/// Returns the sample that a run of a light's shader has left in `g`. No shadow ray of it is pending yet. `question`:
/// LightSample::question.
LightSample sampleOf(Batch& batch, const BoundLight& light, const TmGrid& g, ShadowRays rays, int question);

}  // namespace tomales

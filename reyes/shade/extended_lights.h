// Lights with an extent, which are lamps with geometry and skies: their own samples, and directions that meet them. `g`
// is the grid of a light shader over a batch's points; these functions read and write its Pl, Nl, L and Cl.
#pragma once
#include "reyes/shade.h"

namespace tomales {

class Batch;
struct BoundLight;

/// Unit directions that a surface has drawn itself, one for each point: number `sample` of `samples`. `pdf` is over
/// solid angle; 0 if there is no direction.
struct LobeDirections {
  TmConstVec3 L;
  const float* pdf;
  int sample, samples;
};

bool hasExtent(const BoundLight& light);

/// Makes room for the points on the emitter, which the grid then shows the shader.
EmitterPoints emitterPoints(Batch& batch, const BoundLight& light, TmGrid& g);
/// Samples points on the emitter by the grid's random numbers. Returns false if the light has no geometry. On a light
/// that shines all round, the points cover the whole emitter, and weights make Cl the mean over its area
/// (sampleWholeEmitter()).
bool sampleEmitter(Batch& batch, const BoundLight& light, TmGrid& g, const EmitterPoints& points);
void sampleSky(Batch& batch, const BoundLight& light, TmGrid& g, const EmitterPoints& points);
/// Finds where directions from the points meet the light, and the density of the light's own samples there. A light
/// that shines all round is met in several points of a direction: `layer` counts them. Returns false if nothing can be
/// met.
bool meetLight(Batch& batch, const BoundLight& light, TmGrid& g, const LobeDirections& lobe, int layer,
               const EmitterPoints& points);

/// Runs the light. A sky always lights along the given directions, even if its shader changes L.
bool runWithExtent(Batch& batch, const BoundLight& light, TmGrid& g);
/// Changes Cl after the run of a light for which isMean() is true. Cl is the light that a lamp at one point of the
/// geometry would bring; it becomes the radiance of the geometry there, so that the mean of Cl over the area arrives.
/// The integral of radiance times cosine / distance^2 over the area is pi Cl, because diffuse() is E/pi.
void meanToRadiance(const TmGrid& g, const ShadeServices* services, const BoundLight& light);
/// Converts radiance to what one of its samples adds to E/pi at normal incidence. `pdf` is that of all samples
/// together, over solid angle.
void radianceToSample(const TmGrid& g, const float* pdf);

/// Returns the vectors to just before the points on the emitter, so that its own geometry is not in the way.
TmVec3 beforeEmitter(Batch& batch, const TmGrid& g, float reach);

}  // namespace tomales

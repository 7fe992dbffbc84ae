// Finds the openings through which a sky lights a closed room, and keeps them in the scene, so that a shot and its
// frames have the same ones.
#pragma once
#include "raytrace/trace.h"
#include "reyes/camera.h"
#include "reyes/scene.h"

namespace tomales {

class Log;

/// Tells whether a light of the scene takes openings, and the scene wants them found.
bool wantsSkyPortals(const Scene& scene, const ShadingSystem& shading);

/// Sets Scene::worldFromOpenings to what rays find, and tells the lights, where wantsSkyPortals(). Call it before
/// anything is shaded.
void findSkyPortals(Scene& scene, const Camera& camera, ShadingSystem& shading, const RayScene& rays, Log& log);

}  // namespace tomales

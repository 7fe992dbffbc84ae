// Opens or makes the maps that methods of indirect light need beside rays. A table has a row for each method.
#pragma once
#include "gi/services.h"
#include "reyes/app/settings.h"

namespace tomales {

/// Returns the method of the command line or, if that leaves it to the scene, of its indirect lights.
const GiMethod& methodOf(const RenderSettings& settings, const ShadingSystem& shading);

/// Tells whether photons are counted at visible points before this scene is shaded.
bool countsPhotons(const GiMethod& method, const Scene& scene);

/// All objects that it refers to must outlive the services.
struct FrameOfLight {
  const RaySource& rays;
  const Scene& scene;  ///< The scene that is shaded; that of a shot has no geometry.
  const ShadingSystem& shading;
  const Camera& camera;
  const RenderSettings& settings;
  std::function<void(float)> progress;  ///< Called by any thread with the progress of the maps.
  Checkpoint* kept;                     ///< Null if nothing is kept for a later run.
  Stats& stats;
  Log& log;
};

/// Tells the services where the maps of the method come from: they are opened or made when the first point is gathered.
void setLightSources(GiServices& services, const GiMethod& method, const FrameOfLight& frame);

}  // namespace tomales

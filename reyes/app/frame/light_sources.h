// What methods of indirect light need beside rays: maps that are there, or that are made. A row for each.
#pragma once
#include "gi/services.h"
#include "reyes/app/settings.h"

namespace tomales {

/// The method of the command line or, where that leaves it to the scene, of its indirect lights.
const GiMethod& methodOf(const RenderSettings& settings, const ShadingSystem& shading);

/// All that it refers to outlives the services.
struct FrameOfLight {
  const RaySource& rays;
  const Scene& scene;  ///< That is shaded; of a shot it has no geometry.
  const ShadingSystem& shading;
  const Camera& camera;
  const RenderSettings& settings;
  std::function<void(float)> progress;  ///< Is told how far the maps are, by any thread.
  Stats& stats;
  Log& log;
};

/// Tells the services where the maps of the method come from: they are opened or made when the first point is gathered.
void setLightSources(GiServices& services, const GiMethod& method, const FrameOfLight& frame);

}  // namespace tomales

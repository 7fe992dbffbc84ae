// Verb: points -> colours. It runs shaders over batches of points. It owns the bound shaders of a scene (parameters
// resolved, spaces transformed) and the lights, and asks ShadeServices for all that needs rays or global illumination.
// All light is in the RSL convention, E/pi. Threads: after construction, every const member may be called concurrently.
#pragma once
#include "reyes/base/stats.h"
#include "reyes/grid.h"
#include "reyes/shader_traits.h"

namespace tomales {

class CloudServices;
class ShaderRegistry;

/// The inputs and outputs of ShadingSystem::probe(), which runs a light shader alone, at points that nothing shades.
/// Photons learn from it what light goes where. Everything is in current space.
struct LightProbe {
  std::vector<vec3> P, N;  ///< Input: points to be lit, with their normals.
  /// Input: points on the emitter for LightKind::Area; for Sky directions towards it, and unit directions there.
  std::vector<vec3> Pl, Nl;
  std::vector<vec2> xi;  ///< Input for sampled lights: the place of the one sample; empty for the middle.
  std::vector<vec3> L;   ///< Output: vectors from P to the light.
  std::vector<vec3> Cl;  ///< Output: E/pi at normal incidence; for LightKind::Area and Sky the radiance of the emitter.
  bool finite = true;    ///< Output: false if a value was not finite and was made dark.
};

/// Consecutive pixels of one row after filtering and exposure, for the imager. Arrays are padded.
struct ShadedPixels {
  float x = 0, y = 0;  ///< The raster position of the first pixel's centre.
  int count = 0;
  ShadedPoints colors;
  AlignedVector<float> alpha;
};

class ShadingSystem {
 public:
  /// Binds every surface, displacement and light of the scene; reports unknown shaders and parameters with file:line.
  ShadingSystem(const Scene& scene, ShaderRegistry& registry, const ShadeServices* services, Log& log, Stats& stats);
  ~ShadingSystem();

  /// Services may arrive after construction (they need the ray scene, which needs displacement).
  void setServices(const ShadeServices* services);
  /// Has each point run all its lights, whatever Option "trace" "lightcut" says: pictures of single groups of lights
  /// then add up. Call it before anything is shaded.
  void runAllLights();
  void setClouds(CloudServices* clouds);
  /// Lets shaders print nothing from now on.
  void silence();

  /// Binds the groups that Scene::add() has added. One thread at a time; others may use the older groups meanwhile.
  void bindNewGroups();

  /// Uses the openings to the sky that have been put into the scene since it was bound. Call it before anything is
  /// shaded.
  void takeFoundPortals();

  GroupTraits group(int group) const;
  /// Pre: `light` is an index in Scene::lights.
  LightTraits light(int light) const;

  /// Runs the displacement shader of the grid's object, if it has one, in place, and recomputes N. The grid must then
  /// be a single piece.
  void displace(Grid& grid) const;
  /// Runs the surface shader and the lights over a batch of one group. `out` is resized.
  void shade(const ShadePoints& points, const ShadeContext& context, ShadedPoints& out) const;

  /// Warns if a light takes too few samples at most of the points that were shaded for the camera.
  void warnOfLightNoise() const;

  /// Runs the atmosphere, if there is one, between the eye and points that the camera sees. It changes their colours in
  /// place, and ShadedPoints::airCi.
  void atmosphere(const ShadePoints& points, ShadedPoints& out, const ShadeContext& context = {}) const;
  /// Runs the volume shader, in place, over the colours that rays bring through the volume to the surface that they
  /// start from. The points are those of the surface, except that P is the end of each ray and I leads there from the
  /// surface. Returns false and leaves `out` alone if there is no volume shader or it has failed.
  bool crossVolume(ShadePoints& ends, bool inside, const ShadeContext& context, ShadedPoints& out) const;
  bool hasImager() const;
  /// Runs the imager shader, if there is one, in place.
  void image(ShadedPixels& pixels) const;

  /// Gives the radiance that each point of a batch adds for camera and specular rays if its object is an emitter: the
  /// area light's shader sends it from the front of that point to the origin of the ray. `radiance` is empty if nothing
  /// shines.
  void areaLightRadiance(const ShadePoints& points, std::vector<vec3>& radiance,
                         const ShadeContext& context = {}) const;
  /// Returns the first request among those of all indirect lights but filters; empty if there are no such lights.
  std::optional<IndirectRequest> indirectRequest() const;
  /// Returns the largest number of samples that an area light asks for; 0 if there is none.
  int mostAreaSamples() const;
  bool needsRays() const;  ///< True if a light or shader will trace rays.

  void probe(int light, LightProbe& probe) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales

// Verb: runs shaders over batches of points. Owns the bound shaders of a scene (parameters resolved, spaces
// transformed) and the lights; asks ShadeServices for everything that needs rays or global illumination. Irradiance:
// all light is in the RSL convention, E/pi. Threads: after construction, every const member may be called concurrently.
#pragma once
#include <span>

#include "reyes/base/stats.h"
#include "reyes/grid.h"
#include "reyes/shade_services.h"

namespace tomales {

class ShaderRegistry;

/// Where a light is, as far as one can tell without asking it.
enum class LightKind { None, Ambient, Point, Distant, Sky, Area, Indirect };

/// An opening through which a sky lights a room. Current space.
struct Portal {
  vec3 corner, u, v;  ///< u, v: edges.
  vec3 normal;        ///< As long as the area.
};

/// A light shader alone, at points that nothing shades: how photons learn what it sends where. Current space.
struct LightProbe {
  std::vector<vec3> P, N;  ///< In: points to be lit, with their normals.
  std::vector<vec3> Pl,
      Nl;  ///< In, for LightKind::Area: points on the emitter; for Sky: towards it, and unit directions there.
  std::vector<vec2> xi;  ///< In, for lights that are sampled: where one of one sample lies; none: in the middle.
  std::vector<vec3> L;   ///< Out: from P to the light.
  std::vector<vec3> Cl;  ///< Out: E/pi at normal incidence; for LightKind::Area and Sky the radiance of the emitter.
  bool finite = true;    ///< Out: what was not is dark.
};

/// Consecutive pixels of one row after filtering and exposure, for the imager. Arrays are padded.
struct ShadedPixels {
  float x = 0, y = 0;  ///< Raster position of the centre of the first.
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
  void setClouds(CloudServices* clouds);

  /// After Scene::add(). One thread at a time; others may use the groups that they know of meanwhile.
  void bindNewGroups();

  /// Does a group hide what is behind it (Os = 1 everywhere and a shader that keeps opacity)?
  bool opaque(int group) const;
  /// Does a shader of the group ask how values change over the surface (ShadePoints::hasSteps)?
  bool wantsSteps(int group) const;
  /// Does its shader leave Oi = Os?
  bool keepsOpacity(int group) const;
  /// Runs the displacement shader of the grid's object, in place; recomputes N. No-op without one. Pre: one piece, if
  /// there is one.
  void displace(Grid& grid) const;
  /// Surface shader and lights over a batch of one group. `out` is resized.
  void shade(const ShadePoints& points, const ShadeContext& context, ShadedPoints& out) const;

  /// Of all that the camera has been shown: most of it is lit by too few samples of a light.
  void warnOfLightNoise() const;

  /// Atmosphere between the eye and points that the camera sees, over their colours in place, and ShadedPoints::airCi.
  /// No-op without one.
  void atmosphere(const ShadePoints& points, ShadedPoints& out) const;
  /// Does a volume shader stand inside (Interior) or outside (Exterior) of the group's surfaces?
  bool hasVolume(int group, bool inside) const;
  /// Runs it over what rays bring through the volume to the surface that they leave, in place. The points are those of
  /// the surface, but for kP, which is where each ray ends, and kI, the way there. False, and `out` is left alone:
  /// there is none, or it failed.
  bool crossVolume(ShadePoints& ends, bool inside, const ShadeContext& context, ShadedPoints& out) const;
  bool hasImager() const;
  /// Imager shader, in place. No-op without one.
  void image(ShadedPixels& pixels) const;

  /// Radiance that each point of a batch adds for camera and specular rays if its object is an emitter: what the area
  /// light's shader sends from there to where kI begins, on the front. Empty: nothing shines.
  void emission(const ShadePoints& points, std::vector<vec3>& radiance) const;
  /// The indirect light switched on for a group, if any: what the gather pass must prepare.
  const IndirectQuery* indirectQuery(int group) const;
  /// Of all indirect lights but filters, what the first says that says it; none: there are no such lights.
  std::optional<IndirectRequest> indirectRequest() const;
  /// The largest number of samples that an area light asks for; 0: there is none.
  int mostAreaSamples() const;
  bool needsRays() const;  ///< Some light or shader will trace.
  bool tracesRays(
      int group) const;  ///< Does its surface shader ask for rays, and not for occlusion() or highlights alone?
  bool asksOcclusion(
      int group) const;  ///< May a shader of the group call occlusion() so that answers may be interpolated?

  LightKind lightKind(
      int light) const;  ///< None: its shader is missing, or it lights nothing diffuse that gather rays see.
  void probe(int light, LightProbe& probe) const;
  /// Of a light of LightKind::Sky, those that it names and that have a place and an area.
  std::span<const Portal> portals(int light) const;
  /// What photons meet inside or outside of a group's surfaces: of its Interior or Exterior.
  MediumColors medium(int group, bool inside) const;
  /// Does the surface of a group add radiance of its own?
  bool emits(int group) const;
  /// Does it reflect the same share of Illumination::Unit everywhere (TM_EVEN, and no primitive variable says
  /// otherwise)?
  bool reflectsEvenly(int group) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales

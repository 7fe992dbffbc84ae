// The geometry behind a shot, for rays. It is read again from the RIB when a ray is first wanted; most re-shading never
// wants one.
#pragma once
#include <mutex>

#include "reyes/app/settings.h"
#include "reyes/base/stats.h"
#include "reyes/dfb.h"
#include "reyes/shader_registry.h"

namespace tomales {

/// The geometry, once it has been read.
class RayGeometry {
 public:
  RayGeometry(Scene scene, ShaderRegistry& shaders, const RenderSettings& settings, const ShadeServices* services,
              Stats& stats, Log& log);
  ~RayGeometry();

  /// Takes the shaders, colours and lights of another edit of the same shot. Returns false if the edit changes the
  /// geometry that rays see, which then has to be read again.
  bool dressAs(const Shot& shot, ShaderRegistry& shaders, const ShadeServices* services, Stats& stats, Log& log);
  const RayTools& tools() const { return tools_; }

 private:
  Scene scene_;
  const Camera camera_;
  std::unique_ptr<ShadingSystem> first_;  ///< The shading that the geometry was made with, which goes on displacing.
  std::vector<std::shared_ptr<const Attributes>> attributes_;  ///< Attributes that `first_` is bound to.
  std::vector<std::shared_ptr<LightCall>> lights_;
  std::unique_ptr<RayScene> rays_;
  std::unique_ptr<ShadingSystem> dressed_;  ///< Shading under a later edit; null: `first_` is still used.
  RayTools tools_;
};

/// The parts that one shading of a shot leaves for the next, which uses the same registry of shaders. `geometry` may be
/// null.
struct KeptGeometry {
  std::unique_ptr<ShaderRegistry> shaders;
  std::unique_ptr<RayGeometry> geometry;
};

class RayWorld {
 public:
  /// `shot` has the attributes, lights and options that are shaded, also where rays meet them. The geometry of `kept`
  /// is used if it can be, and left there.
  RayWorld(const Shot& shot, KeptGeometry& kept, const RenderSettings& settings, Stats& stats, Log& log);
  ~RayWorld();

  /// Returns null if the RIB is gone or has changed, which is reported. Threads: any; all wait for the first.
  const RayTools* tools();
  void report() const;  ///< Adds to the Stats; call it after the last ray.
  /// Sets the services that ray hits ask for light and shadows.
  void setServices(const ShadeServices* services) { services_ = services; }

 private:
  bool find();
  std::unique_ptr<RayGeometry> build();
  bool sourcesAreUnchanged() const;
  void dress(Scene& scene) const;

  const Shot& shot_;
  KeptGeometry& kept_;
  const RenderSettings& settings_;
  Stats& stats_;
  Log& log_;
  const ShadeServices* services_ = nullptr;
  std::once_flag once_;
  bool found_ = false;
};

}  // namespace tomales

// The geometry behind a shot, for rays: it is read again from the RIB when a ray is first wanted, which for most
// re-shading is never.
#pragma once
#include <mutex>

#include "reyes/app/settings.h"
#include "reyes/base/stats.h"
#include "reyes/dfb.h"
#include "reyes/shader_registry.h"

namespace tomales {

class RayWorld {
 public:
  /// `shot` has the attributes, lights and options that are shaded, also where rays meet them.
  RayWorld(const Shot& shot, ShaderRegistry& shaders, const RenderSettings& settings, Stats& stats, Log& log);
  ~RayWorld();

  /// Returns null if the RIB is gone or has changed, which is reported. Threads: any; all wait for the first.
  const RayTools* tools();
  void report() const;  ///< Adds to the Stats; call it after the last ray.
  /// Sets the services that ray hits ask for light and shadows.
  void setServices(const ShadeServices* services) { services_ = services; }

 private:
  struct Built;
  std::unique_ptr<Built> build();
  bool sourcesAreUnchanged() const;
  void dress(Scene& scene) const;

  const Shot& shot_;
  ShaderRegistry& shaders_;
  const RenderSettings& settings_;
  Stats& stats_;
  Log& log_;
  const ShadeServices* services_ = nullptr;
  std::once_flag once_;
  std::unique_ptr<Built> built_;
};

}  // namespace tomales

// Composer: the ShadeServices that rays and global illumination stand behind (injected by reyes/app), and the gather pass
// that fills the irradiance cache from the deep frame buffer before anything is shaded.
#pragma once
#include "gi/gather.h"
#include "reyes/deep.h"

#include <atomic>
#include <functional>

namespace tomales {

enum class GiMode {
  None,       ///< Direct light only: indirect lights give nothing.
  Gather,     ///< One bounce, shaded hits, irradiance caching.
  Reference,  ///< Brute-force path tracing of the same transport: unbiased for diffuse surfaces.
};

struct GiSettings {
  GiMode mode = GiMode::Gather;
  int samples = 0;        ///< Rays per record, or paths per point of the reference; 0: as the indirect light asks.
  int bounces = 0;        ///< 0: as the indirect light asks (1 by default).
  float maxError = -1;    ///< As the `maxerror` of indirectlight; < 0: as the light asks.
  uint32_t seed = 0;
};

class GiServices final : public ShadeServices {
 public:
  GiServices(const Scene& scene, const Camera& camera, const RayScene& rays, const ShadingSystem& shading,
             const GiSettings& settings, Stats& stats);
  ~GiServices() override;

  /// Fills the irradiance cache for every point that a shaded frame will ask about, coarse to fine. Records of one level are
  /// frozen before the next reads them, and their order is that of the pixels, so the cache does not depend on threads or buckets.
  void gatherPass(const DeepFrame& frame, const std::function<void(float)>& progress, const std::atomic<bool>* cancelled);

  void transmission(const ShadePoints&, const uint8_t* active, TmConstVec3 toward, const ShadowRays&, const ShadeContext&,
                    TmVec3 light) const override;
  bool sampleEmitter(int light, int count, const float* xi0, const float* xi1, TmVec3 P, TmVec3 N, float* area) const override;
  void indirectDiffuse(const ShadePoints&, const uint8_t* active, TmConstVec3 N, const IndirectQuery&, const ShadeContext&,
                       IndirectResult out) const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales

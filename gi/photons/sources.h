// Private to gi: all that sends photons in a scene, and their paths. Threads: const members may be called concurrently;
// pass() uses the pool.
#pragma once
#include "gi/photons/tracer.h"

namespace tomales {

class PhotonSources {
 public:
  /// maxDepth 0 becomes kEnoughBounces.
  PhotonSources(const RayScene& rays, const ShadingSystem& shading, const PhotonSettings& settings, Log& log);
  PhotonSources(const PhotonSources&) = delete;

  struct Sent {
    const PhotonSource* source;
    size_t count;  ///< Its share by power of the photons that are sent, at least one.
  };
  double power() const { return power_; }  ///< Power of all sources together, in W.
  /// Photons `first` .. `end` - 1 of a source.
  struct PhotonRange {
    Sent from;
    size_t first, end;
  };
  /// Returns the photons of one part of settings().emit. Parts end where tasks do, so that tasks trace the same photons
  /// together as in the whole.
  std::vector<PhotonRange> rangesOf(WorkPart part) const;
  const PhotonSettings& settings() const { return settings_; }

  /// A task's photons fit into the processor's cache.
  static constexpr size_t kPhotonsPerTask = 2048;
  /// Traces photons `first` .. `end` - 1 of a source, in tasks; taken(k, photons) is called concurrently for task k.
  void trace(const Sent& from, uint32_t seed, size_t first, size_t end,
             const std::function<void(size_t task, std::vector<StoredPhoton>&& photons)>& taken) const;
  /// Traces about `emit` photons, which carry power(). `count` is called concurrently, in any order. Returns the number
  /// of photons.
  int64_t pass(uint32_t seed, int64_t emit, const std::function<void(std::span<const StoredPhoton>)>& count) const;

 private:
  std::vector<Sent> shared(int64_t emit) const;

  PhotonSettings settings_;
  std::vector<std::unique_ptr<const PhotonSource>> sources_;
  double power_ = 0;
  PhotonTracer tracer_;
};

}  // namespace tomales

// What shading may ask of point clouds and brick maps. Light is in the RSL convention, E/pi. Space: that of the file.
// Results of points that are not active are left alone. Threads: all members may be called concurrently.
#pragma once
#include "reyes/shade_services.h"

namespace tomales {

/// A lookup of bake3d() or texture3d() in data that shaders keep. Arrays have one length, in the space of the file.
struct CloudQuery {
  std::string file;
  int count = 0;
  const uint8_t* active = nullptr;
  TmConstVec3 P{}, N{};  ///< N has unit length or is zero.
  const float* radius = nullptr;
};
struct CloudValue {
  std::string name;
  int floats = 1;
  float* c[3] = {nullptr, nullptr, nullptr};
};

/// The disks of a point cloud that cover a hemisphere.
struct DisksQuery {
  std::string channel;          ///< The channel that the disks send.
  float maxSolidAngle = 0.01f;  ///< Disks that are seen together under less count as one.
  bool clamp = true;            ///< Disks behind others do not count.
  float coneAngle = kPi / 2;    ///< The half angle of the cone that is looked at.
  HemisphereQuery falloff;
};

/// The interface to point clouds and brick maps (implemented in gi/clouds, injected by reyes/app). `problem` says why
/// false is returned.
class CloudServices {
 public:
  virtual ~CloudServices() = default;
  virtual bool bake(const CloudQuery&, const std::vector<CloudValue>&, std::string& problem) = 0;
  virtual bool lookUp(const CloudQuery&, const std::vector<CloudValue>&, float* found, std::string& problem) = 0;
  /// Gives E/pi from a photon map.
  virtual bool photons(const CloudQuery&, const TmPhotonOptions&, TmVec3 E, std::string& problem) = 0;
  /// Gives the share of the hemisphere around N that is covered, weighted by the cosine, and (unless x is null) the
  /// mean radiance that arrives from it. `coarse` is the share where disks are too large for a point that is so near.
  virtual bool occlusion(const CloudQuery&, const DisksQuery&, float* covered, TmVec3 radiance, float* coarse,
                         std::string& problem) = 0;
  /// Gives baked light that leaves after diffusion, as E/pi.
  virtual bool subsurface(const CloudQuery&, const TmSubsurfaceOptions&, TmVec3 out, std::string& problem) = 0;
};

}  // namespace tomales

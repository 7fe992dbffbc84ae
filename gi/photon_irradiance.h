// Verb: photons -> irradiance disks (irradiance-atlas 4). The irradiance at photons from the nearest of them
// that lie on the same surface, and from the same search the area that each stands for. Irradiance:
// `irradiance` of the result is E in W/m2, not E/pi. Threads: uses the pool; the result does not depend on
// it.
#pragma once
#include <functional>

#include "gi/point_cloud.h"

namespace tomales {

struct PhotonIrradianceSettings {
  int nearest = 50;  ///< The paper's.
  int every = 4;     ///< One estimate for so many neighbouring photons (Christensen 1999, "Faster photon map
                     ///< global illumination").
  float maxRadius =
      0;  ///< Photons farther away do not count, however few there are; 0: a twentieth of the map's diagonal.
};

/// Of photons in media: W m, from which comes "fluence" (W/m2), 4 pi times the mean radiance from all sides
/// (Jensen and Christensen 1998, eq. 7 with the free path for what scatters).
inline constexpr const char* kPathPower = "pathpower";
/// Of photons on surfaces, W; and where those that came straight from lights are left out, from which comes
/// "indirect" (W/m2).
inline constexpr const char *kPower = "power", *kIndirectPower = "indirectpower";
inline constexpr const char *kIrradiance = "irradiance", *kIndirectIrradiance = "indirect";

/// Estimates, and those of them that stand on weak ground.
struct EstimateFigures {
  int64_t made = 0;
  int64_t few = 0;    ///< Fewer photons were in reach than were asked for: light is smeared as far as that, and
                      ///< noisy all the same.
  int64_t bent = 0;   ///< The surface bends within the disk, which is no disk then.
  double clumps = 0;  ///< Density of the nearest few over that of the disk, summed: 1 each in the mean on
                      ///< even ground; photons lie in clumps where surfaces are smaller than the disk.
  EstimateFigures& operator+=(const EstimateFigures& o) {
    return made += o.made, few += o.few, bent += o.bent, clumps += o.clumps, *this;
  }
};

/// `photons` needs a channel kPower or kIndirectPower of three floats, and normals, or kPathPower. The result
/// has the channel of irradianceChannels(); its disks, or balls, overlap enough to cover the surface, or fill
/// the volume. No photons make an empty cloud. `wanted`: only at photons there; null: at all. `figures`:
/// gains what was made on surfaces; may be null.
PointCloud estimateIrradiance(PointCloud photons, const PhotonIrradianceSettings& settings,
                              const std::function<bool(const vec3& P)>& wanted = {},
                              EstimateFigures* figures = nullptr);

/// The channels of the result: `irradiance`, `indirect` or `fluence`, and which surface it is of where
/// photons tell.
std::vector<CloudChannel> irradianceChannels(const std::vector<CloudChannel>& photons);

/// The radius beyond which photons do not count, on a map of this bound.
float reachOf(const PhotonIrradianceSettings& settings, const Bound3& map);

/// Share of a disk that a straight border leaves, by how far the centroid of what is left lies from the
/// centre, in radii: 1 at 0, 1/2 at 4/(3 pi). What photons near the border of a surface are short of.
float coveredShare(float centroidDistance);
/// The same of a ball and a plane: 1/2 at 3/8.
float coveredShareOfBall(float centroidDistance);

}  // namespace tomales

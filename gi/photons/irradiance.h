// Verb: photons -> irradiance disks (Christensen and Batali 2004, section 4). The nearest photons on the same surface
// give the irradiance at a photon, and the same search gives the area that it stands for. Irradiance: `irradiance` of
// the result is E in W/m2, not E/pi. Threads: uses the pool; the result does not depend on it.
#pragma once
#include <array>
#include <functional>

#include "gi/point_file.h"

namespace tomales {

struct PhotonIrradianceSettings {
  int nearest = 50;  ///< The paper's number of photons in an estimate; at least 2.
  /// One estimate is made for this many neighbouring photons (Christensen 1999, "Faster photon map global
  /// illumination").
  int every = 4;
  /// Photons farther away do not count, however few there are; 0: a twentieth of the map's diagonal.
  float maxRadius = 0;
};

/// Channel of photons in media, in W m. It gives "fluence" (W/m2), 4 pi times the mean radiance from all sides (Jensen
/// and Christensen 1998, eq. 7 with the free path for scattering).
inline constexpr const char* kPathPower = "pathpower";
/// Channels of photons on surfaces, in W. kIndirectPower leaves out photons that came straight from lights, and gives
/// "indirect" (W/m2).
inline constexpr const char *kPower = "power", *kIndirectPower = "indirectpower";
/// Channels of their irradiance, in W/m2.
inline constexpr const char *kIrradiance = "irradiance", *kIndirectIrradiance = "indirect";
/// Returns the place of the power of photons on surfaces, three floats; -1 if they have none.
inline int surfacePowerOffset(const std::vector<CloudChannel>& channels) {
  return std::max(offsetOf(channels, kPower, 3), offsetOf(channels, kIndirectPower, 3));
}
/// Returns the place of the power of photons on surfaces or in media; -1 if they are no photons.
inline int powerOffset(const std::vector<CloudChannel>& channels) {
  return std::max(offsetOf(channels, kPathPower, 3), surfacePowerOffset(channels));
}
/// Throws FileError unless a file has one of these channels of photons on surfaces.
void requirePhotons(const PointFile& file);

/// Sums over a part of the picture.
struct PictureShare {
  double pixels = 0, x = 0, y = 0;  ///< x and y: raster coordinates, weighted by pixels.
  PictureShare& operator+=(const PictureShare& o) {
    pixels += o.pixels;
    x += o.x;
    y += o.y;
    return *this;
  }
};
/// Returns how the picture shows a disk; nothing where it does not.
using ShownDisk = std::function<PictureShare(const vec3& P, const vec3& N, float radius)>;

/// Counts of estimates, and of the unreliable ones among them.
struct EstimateFigures {
  int64_t made = 0;
  /// Estimates with fewer photons in reach than were asked for: light is smeared over the whole reach, and still noisy.
  int64_t few = 0;
  int64_t bent = 0;  ///< Estimates whose surface bends within the disk, so that the disk does not fit it.
  /// The density of the nearest few photons over that of the whole disk, summed over the estimates. Its mean is 1 on
  /// even ground, and more where surfaces are smaller than the disk, because photons lie in clumps there.
  double clumps = 0;
  PictureShare shown, shownFew;  ///< What the picture shows of the estimates, and of those of very few photons.
  EstimateFigures& operator+=(const EstimateFigures& o) {
    made += o.made;
    few += o.few;
    bent += o.bent;
    clumps += o.clumps;
    shown += o.shown;
    shownFew += o.shownFew;
    return *this;
  }
};

/// Distances from P, along a surface with normal N, to walls behind which the surface goes on; they are at most
/// `reach`. The directions are evenly spaced and start with the tangent of orthonormalBasis(). Threads: calls are
/// concurrent.
constexpr size_t kSightLines = 8;
using SightLines = std::array<float, kSightLines>;
using SightAlongSurface = std::function<SightLines(const vec3& P, const vec3& N, float reach)>;

/// `photons` needs normals and a channel kPower or kIndirectPower of three floats, or kPathPower. The result has the
/// channels of irradianceChannels(); its disks, or balls, overlap enough to cover the surface, or fill the volume. No
/// photons make an empty cloud. `wanted`: estimates are made only at photons that it accepts; empty: at all photons.
/// `figures`: gains the counts of estimates on surfaces; may be null. `sight`: where walls on the surface separate more
/// light from less, the estimate has the surface number kAcrossWalls; empty: walls are not known. `shown`: for the
/// figures; empty: the picture is not known.
PointCloud estimateIrradiance(PointCloud photons, const PhotonIrradianceSettings& settings,
                              const std::function<bool(const vec3& P)>& wanted = {}, EstimateFigures* figures = nullptr,
                              const SightAlongSurface& sight = {}, const ShownDisk& shown = {});

/// Returns the channels of the result: `irradiance`, `indirect` or `fluence`, and the surface number where the photons
/// have it.
std::vector<CloudChannel> irradianceChannels(const std::vector<CloudChannel>& photons);

/// Returns the radius beyond which photons do not count, on a map of this bound.
float reachOf(const PhotonIrradianceSettings& settings, const Bound3& map);

/// Returns the share of a disk that remains on one side of a straight border, by the distance of the remainder's
/// centroid from the centre, in radii: 1 at 0, 1/2 at 4/(3 pi). It corrects estimates near the border of a surface.
float coveredShare(float centroidDistance);
/// Returns the same for a ball and a plane: 1/2 at 3/8.
float coveredShareOfBall(float centroidDistance);

}  // namespace tomales

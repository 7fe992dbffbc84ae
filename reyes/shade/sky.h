// Where a light that is all around, at infinity, is sampled: half by the brightness of its picture, half by the cosine
// with the normal; without a picture by the cosine alone. A bright sun of a few texels is found by as many samples as
// it is worth. Before that, most go through portals if there are any. Space: current. Threads: const members may be
// called concurrently.
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "reyes/base/distribution.h"
#include "reyes/base/math.h"
#include "reyes/base/simd.h"
#include "reyes/shade/portals.h"
#include "reyes/shade/texture.h"

namespace tomales {

/// Latitude-longitude pictures (RISpec 3.2, MakeLatLongEnvironment): +z of the world at the top, +x at the left edge,
/// +y a quarter to the right. s and t in 0..1, t downwards.
vec2 latLong(const vec3& worldDirection);
vec3 latLongDirection(const vec2& st);

constexpr float kSkyCell = 2 * kPi / 1024;  ///< Radians: brightness is known by cells of this size.

class Sky {
 public:
  /// The same from everywhere.
  Sky() = default;
  /// `picture` in world space; what cannot be read is reported, and even.
  Sky(const Textures& textures, const std::string& picture, const SourceLoc& where, const std::string& user,
      const mat3& worldFromCurrent);

  void setPortals(Portals portals) { portals_ = std::move(portals); }
  const Portals& portals() const { return portals_; }

  /// A unit direction to light a point P with unit normal N by; density over solid angle. N of 0: in the air, lit
  /// evenly from all sides.
  vec3 sample(const vec3& P, const vec3& N, vec2 xi, float& density) const;
  float density(const vec3& P, const vec3& N, const vec3& L) const;

 private:
  vec3 openSample(const vec3& N, vec2 xi) const;
  float openDensity(const vec3& N, const vec3& L) const;
  float pictureDensity(const vec3& L) const;

  Distribution rows_;
  std::vector<Distribution> row_;  ///< Cells of each; none: no picture.
  mat3 worldFromCurrent_{1.0f};
  Portals portals_;
};

/// The orientation of a sky that stands in a space, whatever the scale of that.
mat3 skyFromCurrent(const mat4& currentFromSpace);

/// Those that shaders name, which stand in the world. Threads: concurrent calls are safe.
class Skies {
 public:
  Skies(const Textures& textures, const mat3& worldFromCurrent)
      : textures_(textures), worldFromCurrent_(worldFromCurrent) {}
  const Sky& find(const std::string& picture, const SourceLoc& where, const std::string& user) const;

 private:
  const Textures& textures_;
  const mat3 worldFromCurrent_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, Sky> skies_;
};

}  // namespace tomales

// Samples a light that is all around, at infinity: half by the brightness of its picture, half by the cosine with the
// normal; without a picture by the cosine alone. A bright sun of a few texels gets samples in proportion to its light.
// If there are portals, most samples go through them first. Space: current. Threads: const members may be called
// concurrently.
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
#include "reyes/shader_traits.h"

namespace tomales {

/// Returns the picture coordinates of a direction in a latitude-longitude picture (RISpec 3.2, MakeLatLongEnvironment).
/// +z of the world is at the top, +x at the left edge, and +y a quarter of the width to the right. s and t are in 0..1,
/// and t runs down.
vec2 latLong(const vec3& worldDirection);
vec3 latLongDirection(const vec2& st);

constexpr float kSkyCell = 2 * kPi / kSkyColumns;  ///< The size in radians of the cells of brightness.

class Sky {
 public:
  /// Makes a sky that is equally bright everywhere.
  Sky() = default;
  /// `picture` is oriented in world space. A picture that cannot be read is reported, and the sky is equally bright
  /// everywhere.
  Sky(const Textures& textures, const std::string& picture, const SourceLoc& where, const std::string& user,
      const mat3& worldFromCurrent);

  void setPortals(Portals portals) { portals_ = std::move(portals); }
  const Portals& portals() const { return portals_; }

  /// Returns a unit direction from which to light a point P with unit normal N, and its density over solid angle. For
  /// an N of 0, in the air, directions are uniform.
  vec3 sample(const vec3& P, const vec3& N, vec2 xi, float& pdf) const;
  float pdf(const vec3& P, const vec3& N, const vec3& L) const;

 private:
  vec3 openSample(const vec3& N, vec2 xi) const;
  float openPdf(const vec3& N, const vec3& L) const;
  float picturePdf(const vec3& L) const;

  Distribution rows_;
  std::vector<Distribution> row_;  ///< The cells of each row; empty without a picture.
  mat3 worldFromCurrent_{1.0f};
  Portals portals_;
};

/// Returns the orientation of a sky in a space, without the scale of that space.
mat3 skyFromCurrent(const mat4& currentFromSpace);

/// The skies of pictures that shaders name, in world space. Threads: concurrent calls are safe.
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

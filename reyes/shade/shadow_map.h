// Shadow maps for shaders: pictures of depth, or of opacity over depth, that a Display of type "shadow", "zfile" or
// "deepshad" has written. Threads: concurrent lookups are safe.
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "reyes/base/log.h"
#include "reyes/base/math.h"

namespace tomales {

struct DepthCamera;
struct PictureShape;
class PictureReader;

/// A point of a plane, in world space, that may lie in shadow.
struct ShadowReceiver {
  vec3 P, N;
  vec3 edgeU, edgeV;  ///< The edges of its micropolygon, over which the lookup filters.
};

struct ShadowLookup {
  /// Distance by which a surface must be nearer to the light to cast a shadow; negative: by slope and texel size.
  float bias = -1;
  float blur = 0;    ///< Added to the filtered region, as a fraction of the map.
  float width = 1;   ///< Scales the micropolygon.
  int samples = 16;  ///< At least 1.
  uint32_t seed = 0;
};

class ShadowMap {
 public:
  /// Returns null if it cannot be read; `error` then says why.
  static std::unique_ptr<const ShadowMap> read(const std::string& path, std::string& error);

  /// Returns the share of light that is blocked: 1 for all, 0 outside the map. It is percentage-closer filtering
  /// (Reeves, Salesin and Cook 1987); in deep maps each sample is the light that the opacity in front of the point
  /// blocks (Lokovic and Veach 2000). The receiver's depth is followed along its plane, so that a large region needs no
  /// bias.
  vec3 shadow(const ShadowReceiver& receiver, const ShadowLookup& lookup) const;

 private:
  struct DeepSample {
    float z, zBack;
    vec3 before, after;  ///< The share of light that arrives at z, and at zBack.
  };
  struct View;
  void readCamera(const PictureShape& shape, const DepthCamera& camera);
  // Both read the channel `z` of a picture. They return false if it cannot be read; the reader's error() then says why.
  bool readFlat(PictureReader& in, int z);
  bool readDeep(PictureReader& in, int z);
  /// Finds the receiver in the map, with its edges multiplied by `width`. Returns nothing if it is outside of the map.
  std::optional<View> viewOf(const ShadowReceiver& receiver, float width) const;
  vec3 blocked(int x, int y, float z) const;

  int width_ = 0, height_ = 0;                    ///< The size of the frame,
  int x0_ = 0, y0_ = 0, columns_ = 0, rows_ = 0;  ///< and the part of it that the file holds.
  mat4 cameraFromWorld_{1.0f}, ndcFromWorld_{1.0f};
  mat3 cameraNormalFromWorld_{1.0f};
  bool perspective_ = false;
  vec2 spread_{1.0f};          ///< The width and height in texels of the region whose depths a texel holds.
  std::vector<float> depth_;   ///< Empty for a deep map.
  std::vector<size_t> first_;  ///< The index of each texel's first sample; one more than there are texels.
  std::vector<DeepSample> samples_;
};

class ShadowMaps {
 public:
  ShadowMaps(std::string searchPath, Log& log) : searchPath_(std::move(searchPath)), log_(log) {}
  /// Returns null if it cannot be read, which has been reported as missing.
  const ShadowMap* find(const std::string& name, const SourceLoc& where, const std::string& user) const;

 private:
  const std::string searchPath_;
  Log& log_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::unique_ptr<const ShadowMap>> maps_;
};

}  // namespace tomales

// Shadow maps for shaders: pictures of depth, or of opacity over depth, that a Display of type "shadow", "zfile" or
// "deepshad" has left. Threads: concurrent lookups are safe.
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "reyes/base/log.h"
#include "reyes/base/math.h"

namespace tomales {

/// A place that may lie in shadow: a point of a plane, world space.
struct ShadowReceiver {
  vec3 P, N;
  vec3 edgeU, edgeV;  ///< The micropolygon around it, which the lookup covers.
};

struct ShadowLookup {
  float bias = -1;  ///< Depth by which a surface must be nearer to the light; negative: by slope and texel size.
  float blur = 0;   ///< Added to the covered region, as a fraction of the map.
  float width = 1;  ///< Scales the micropolygon.
  int samples = 16;
  uint32_t seed = 0;
};

class ShadowMap {
 public:
  /// Null: `error` says why.
  static std::unique_ptr<const ShadowMap> read(const std::string& path, std::string& error);

  /// 1: all light is blocked. Percentage-closer filtering (Reeves, Salesin and Cook 1987); in deep maps each sample is
  /// one less what the opacity before it lets through (Lokovic and Veach 2000). Lit outside the map. The receiver's
  /// depth is followed along its plane, so that the size of the region asks for no bias.
  vec3 shadow(const ShadowReceiver& receiver, const ShadowLookup& lookup) const;

 private:
  struct Step {
    float z, zBack;
    vec3 before, after;  ///< Fraction of light that arrives at z, at zBack.
  };
  struct View;
  vec3 blocked(int x, int y, float z) const;

  int width_ = 0, height_ = 0;                    ///< Of the frame,
  int x0_ = 0, y0_ = 0, columns_ = 0, rows_ = 0;  ///< and of the part of it that the file holds.
  mat4 cameraFromWorld_{1.0f}, ndcFromWorld_{1.0f};
  mat3 cameraNormalFromWorld_{1.0f};
  bool perspective_ = false;
  vec2 spread_{1.0f};          ///< Texels, wide and high, of the region whose depths a texel holds.
  std::vector<float> depth_;   ///< Empty: a deep map.
  std::vector<size_t> first_;  ///< Of the steps of a texel, one more than there are texels.
  std::vector<Step> steps_;
};

class ShadowMaps {
 public:
  ShadowMaps(std::string searchPath, Log& log) : searchPath_(std::move(searchPath)), log_(log) {}
  /// Null: it cannot be read, which has been reported as missing.
  const ShadowMap* find(const std::string& name, const SourceLoc& where, const std::string& user) const;

 private:
  const std::string searchPath_;
  Log& log_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::unique_ptr<const ShadowMap>> maps_;
};

}  // namespace tomales

// Pictures for shaders; OpenImageIO lives behind this file. Threads: concurrent lookups are safe.
#pragma once
#include <memory>

#include "reyes/base/log.h"
#include "reyes/base/stats.h"
#include "reyes/shader_api.h"

namespace tomales {

/// Which texels a batch asks for: (s[i], t[i]) over a box of (width, height), all in 0..1 of the picture.
struct TextureQuery {
  const char* name;
  int channel, channels;
  int count;
  const uint8_t* active;
  const float *s, *t, *width, *height;
  bool latlong = false;  ///< The left and right edge join; beyond top and bottom lies the edge.
};

class Textures {
 public:
  /// `searchPath`: colon-separated folders.
  Textures(const std::string& searchPath, Log& log, Stats& stats);
  ~Textures();
  /// Fills out.x (and y, z for three channels). False: unreadable, reported, `out` is magenta.
  bool lookup(const TextureQuery& query, const SourceLoc& where, const std::string& user, TmVec3 out) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales

// Pictures for shaders. Threads: concurrent lookups are safe.
#pragma once
#include <memory>

#include "reyes/base/log.h"
#include "reyes/base/stats.h"
#include "reyes/pictures.h"

namespace tomales {

class Textures {
 public:
  Textures(const TextureSettings& settings, Log& log, Stats& stats);
  ~Textures();
  /// Fills out.x (and y, z for three channels). Returns false if the picture is unreadable: that is reported, and `out`
  /// is magenta.
  bool lookup(const TextureQuery& query, const SourceLoc& where, const std::string& user, TmVec3 out) const;
  /// Does the same as TextureCache::info(). It reports nothing.
  bool info(const std::string& name, const std::string& what, std::vector<float>& numbers, std::string& text) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales

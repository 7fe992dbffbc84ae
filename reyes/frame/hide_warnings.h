// Private to reyes/frame: warnings where hiding reaches its limits, from the uncertain samples that the buckets of a
// frame counted. Threads: add() is concurrent. The warnings depend on buckets, not on threads.
#pragma once
#include <map>
#include <mutex>
#include <tuple>

#include "reyes/base/log.h"
#include "reyes/hide.h"

namespace tomales {

class HideWarnings {
 public:
  /// Pre: the bucket's objects still exist, because their indices may be reused later.
  void add(const HideDiagnostics& ofBucket, const Scene& scene);
  void report(Log& log) const;

 private:
  /// Source location of an object, and its name.
  struct Site {
    SourceLoc where;
    std::string name;
    auto key() const { return std::tuple(where.file ? *where.file : std::string(), where.line, name); }
    bool operator<(const Site& o) const { return key() < o.key(); }
  };
  static Site siteOf(const Scene& scene, int object);

  std::mutex mutex_;
  std::map<std::pair<Site, Site>, int> samePlaces_;  ///< Number of pixels.
  HideDiagnostics::Turns all_;
  std::map<Site, int64_t> turned_;
};

}  // namespace tomales

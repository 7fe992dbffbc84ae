// Where hiding comes to its limits, as warnings: what the buckets of a frame were in doubt about. Private to
// reyes/frame. Threads: add() is concurrent. The warnings depend on buckets, not on threads.
#pragma once
#include <map>
#include <mutex>
#include <tuple>

#include "reyes/base/log.h"
#include "reyes/hide.h"

namespace tomales {

class HideWarnings {
 public:
  /// Pre: the bucket's objects are still there; others get their numbers.
  void add(const HideDoubts& ofBucket, const Scene& scene);
  void report(Log& log) const;

 private:
  /// Where an object is told, and its name.
  struct Site {
    SourceLoc where;
    std::string name;
    auto key() const { return std::tuple(where.file ? *where.file : std::string(), where.line, name); }
    bool operator<(const Site& o) const { return key() < o.key(); }
  };
  static Site siteOf(const Scene& scene, int object);

  std::mutex mutex_;
  std::map<std::pair<Site, Site>, int> samePlaces_;  ///< Pixels
  HideDoubts::Turns all_;
  std::map<Site, int64_t> turned_;
};

}  // namespace tomales

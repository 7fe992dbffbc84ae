// Private to gi: irradiance caches for the points that gather rays meet, one for each further bounce. They are coarse,
// because one record averages hundreds of lookups; a hit that none of their records serves goes on as a path. E here is
// E/pi. Threads: filled before anything is shaded, frozen after. While a level is filled, the one before is looked up.
// Space: current.
#pragma once

#include "gi/frame/record_slices.h"
#include "gi/gather.h"
#include "gi/gather/bounces_left.h"
#include "gi/services.h"
#include "reyes/base/stop.h"

namespace tomales {

class BounceCaches {
 public:
  struct Run {
    Stats& stats;
    StopToken stop;
    Checkpoint* kept;                     ///< May be null.
    std::span<const std::string> groups;  ///< The groups of lights whose shares are kept.
  };
  /// Fills levels for `bounces` of light. `gather` gives the settings of the points that look them up. Records lie
  /// where rays from `from` end, and where the rays of these records do. It ends early when another level would add
  /// next to nothing.
  void fill(const RayTools& tools, const Camera& camera, const std::vector<GatherPoint>& from,
            const GatherSettings& gather, int bounces, const Run& run);
  /// The members that lookup() needs, for files.
  struct Levels {
    Bound3 bound;
    std::vector<std::vector<IrradianceRecord>> records;  ///< Indexed by level.
    std::vector<std::string> groups;                     ///< Each record has the share of each of these.
    float leastDistance = 0;
  };
  Levels levels() const;
  void restore(const Levels& levels);
  /// Returns E/pi after `bounces` bounces. A weight of 0 means that it is not known. lights: null, or one of
  /// Run::groups, whose lights alone shine.
  IrradianceEstimate lookup(int bounces, const Camera& camera, const vec3& P, const vec3& normal,
                            const vec3& shadingNormal, const std::string* lights) const;
  /// Returns the light that fill() has left out. The result is empty if fill() ended early because little was left, or
  /// if there are too few bounces to tell a ratio.
  BouncesLeft left() const;

 private:
  std::vector<GatherPoint> hitsFrom(const RayScene& rays, const Camera& camera, const std::vector<GatherPoint>& from,
                                    uint32_t name) const;
  void cover(const RayTools& tools, const std::vector<GatherPoint>& candidates, const GatherSettings& gather,
             const Run& run);
  RecordSlice recordsAt(const RayTools& tools, const std::vector<GatherPoint>& points, const GatherSettings& gather,
                        const Run& run, bool findsLight);
  void insert(IrradianceCache& level, const std::vector<IrradianceRecord>& records);
  void finishLevel(const Camera& camera);
  void mixLevel();
  bool settled() const;
  float pixelSize(const Camera& camera, const vec3& P) const;

  std::vector<IrradianceCache> levels_;  ///< levels_[k] holds the light after k + 1 bounces.
  std::vector<std::string> groups_;
  /// alone_[k][g]: the light of the records of level k with the lights of group g alone.
  std::vector<std::vector<std::vector<IrradianceExpansion>>> alone_;
  std::vector<double> light_;        ///< Sum of the records of each level.
  std::vector<GatherPoint> points_;  ///< The points of the records, the same on all levels.
  BrightSpots spots_;                ///< Some rays of each record are aimed at these.
  float leastDistance_ = 0;
  RecordSlices slices_{nullptr, KeptKind::BounceRecords};
};

}  // namespace tomales

// Noun: an irradiance cache. It holds records with position, normal, E, gradients and dominant directions in an octree;
// an error function says how far each may be used. Equations are those of Tabellion and Lamorlette 2004, "An
// Approximate Global Illumination System for Computer Generated Films". It needs reyes/base alone. Irradiance: E here
// is irradiance / pi (the RSL convention), as everywhere behind indirectDiffuse(). Space: that of the caller, the same
// for insert and lookup. Threads: lookups are concurrent and lock-free as long as nobody inserts.
#pragma once
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "gi/cache/irradiance_record.h"
#include "gi/error_function.h"
#include "reyes/base/block_vector.h"

namespace tomales {

using IrradianceRecords = BlockVector<IrradianceRecord>;

struct CacheSettings {
  ErrorFunction errorFunction = ErrorFunction::Screen;
  /// kappa of eq. 2: it divides the radii of records. If it is infinite, no record is reused.
  float kappa = infoOf(ErrorFunction::Screen).kappa;
  /// R+ (Attribute "irradiance" "maxpixeldist") and R- of eq. 3, in roots of the projected pixel area.
  float maxPixels = infoOf(ErrorFunction::Screen).maxPixels, minPixels = infoOf(ErrorFunction::Screen).minPixels;
  /// Sum of weights that a point needs to be interpolated; with less it gets its own record.
  float minWeight = infoOf(ErrorFunction::Screen).minWeight;
  bool operator==(const CacheSettings&) const = default;
};

struct IrradianceEstimate {
  vec3 E;  ///< E/pi per channel
  vec3 dominant[3];
  float weight = 0;           ///< Sum of weights; 0: nothing usable was found.
  bool inconsistent = false;  ///< The records used are few, and differ by more than their noise explains.
  bool hasRecord = false;     ///< A record lies at this very place.
  float closest = kInfinity;  ///< Least closest distance of the records used.
  /// A lower bound of the heights of the occluders over the records used. `closest` may be less: a record beside an
  /// occluder has met its edge.
  float occluderHeight = kInfinity;
};

/// A place at which irradiance is looked up. Records that serve `normal` are chosen, and extrapolated to
/// `shadingNormal`.
struct IrradiancePlace {
  vec3 position, normal, shadingNormal;
  float pixelSize;  ///< Root of the projected pixel area.
};

class IrradianceCache {
 public:
  /// `bound` should hold all records; records outside of it still work, only slower.
  IrradianceCache(const Bound3& bound, const CacheSettings& settings);
  IrradianceCache(IrradianceCache&&) noexcept;
  IrradianceCache& operator=(IrradianceCache&&) noexcept;
  ~IrradianceCache();

  /// Adds a record. Where an older record is wrong at the new one's place by more than noise explains, its validity
  /// radius is cut to end before that place, and likewise the new one's at the older place.
  void insert(const IrradianceRecord& record);
  /// Adds one of records() of an earlier cache with these settings, unchanged.
  void restore(const IrradianceRecord& record);
  /// Makes lookups of single places several times as fast; their results stay the same. mostPixels(box) returns the
  /// greatest pixelSize of the lookups in a box; those that have a greater one are slow, but right. Pre: no record is
  /// added later.
  void finish(const std::function<float(const Bound3&)>& mostPixels);
  /// Returns the weighted mean of the extrapolated records (eq. 5, 7): those that serve `normal`, turned to
  /// `shadingNormal`. pixelSize: root of the projected pixel area at x. light: as in the lookup of many places below.
  IrradianceEstimate lookup(const vec3& x, const vec3& normal, const vec3& shadingNormal, float pixelSize,
                            std::span<const IrradianceExpansion> light = {}) const;
  IrradianceEstimate lookup(const vec3& x, const vec3& normal, float pixelSize) const {
    return lookup(x, normal, normal, pixelSize);
  }
  /// Looks up many places and writes to out[0] and on. It is several times as fast as single lookups where successive
  /// places lie close together.
  /// `wider`: factor on validity radii. It is less where light is steep, and no radius grows beyond a disagreement
  /// (Amendment::Reach).
  /// `light`: if not empty, it has an element for each record, which replaces E and the derivatives of that record. The
  /// records themselves still decide where they are used, and the dominant directions stay. So the E that is found is
  /// linear in `light`.
  void lookup(std::span<const IrradiancePlace> places, IrradianceEstimate* out, float wider = 1,
              std::span<const IrradianceExpansion> light = {}) const;
  /// Returns the light of each record where each share is multiplied by its gain. Pre: every record has as many shares.
  std::vector<IrradianceExpansion> mixed(std::span<const vec3> gains) const;
  /// Returns the same. The cache keeps it until it is asked for other gains or has more records, because a frame that
  /// is shaded again and again asks for the same. Threads: one at a time.
  std::span<const IrradianceExpansion> cachedMix(std::span<const vec3> gains) const;
  const IrradianceRecords& records() const;
  const Bound3& bound() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales

// Noun: an irradiance cache. Records with position, normal, E, gradients and dominant directions in an octree; an error
// function says how far each may be used. Over reyes/base alone.
// Irradiance: E here is irradiance / pi (the RSL convention), as everywhere behind indirectDiffuse().
// Space: that of the caller, the same for insert and lookup. Threads: lookups are concurrent and lock-free as long as
// nobody inserts.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "gi/irradiance_record.h"
#include "reyes/base/block_vector.h"

namespace tomales {

using IrradianceRecords = BlockVector<IrradianceRecord>;

enum class ErrorFunction {
  Screen,   ///< approximate-gi eq. 2 to 5
  Ward,     ///< Split sphere, with the limits of Screen.
  Hessian,  ///< Schwarzhaupt, Jensen, Jarosz 2012
  Split,    ///< Ward and Heckbert 1992: no limits in pixels, no disputes. To compare with,
  Plain,    ///< and Screen as published: no disputes, and each record says what its own gradients do.
};

struct CacheSettings {
  ErrorFunction errorFunction = ErrorFunction::Screen;
  float kappa = 1;       ///< Eq. 2: records reach 1 / kappa as far. Infinite: nothing is ever reused.
  float maxPixels = 10;  ///< R+ of eq. 3, in roots of the projected pixel area (Attribute "irradiance" "maxpixeldist"),
  float minPixels = 1.5f;  ///< and R-
  float enough = 0.05f;    ///< Sum of weights that a point is to find; else it gets its own record.
  bool operator==(const CacheSettings&) const = default;
};

struct IrradianceEstimate {
  vec3 E;
  vec3 dominant[3];
  float weight = 0;            ///< Sum of weights; 0: nothing usable was found.
  bool disputed = false;       ///< Records differ by more than their noise explains.
  bool hasRecord = false;      ///< At this very place.
  float closest = kInfinity;   ///< The least of the records used: the more there are, the less.
  float headroom = kInfinity;  ///< No sheet over any of them is lower, though some may have met its edge.
};

/// Where irradiance is looked up: records that serve `normal`, turned to `shadingNormal`.
struct IrradiancePlace {
  vec3 position, normal, shadingNormal;
  float pixelSize;  ///< Root of the projected pixel area.
};

class IrradianceCache {
 public:
  /// `bound` should hold all records; what falls outside still works, only slower.
  IrradianceCache(const Bound3& bound, const CacheSettings& settings);
  IrradianceCache(IrradianceCache&&) noexcept;
  IrradianceCache& operator=(IrradianceCache&&) noexcept;
  ~IrradianceCache();

  /// A record that is off at the place of a new one, by more than noise explains, ends before it; and the new one
  /// before the old.
  void insert(const IrradianceRecord& record);
  /// One of records() of an earlier cache with these settings: goes in as it is.
  void restore(const IrradianceRecord& record);
  /// Weighted mean of the extrapolated records (eq. 5, 7): those that serve `normal`, turned to `shadingNormal`.
  /// pixelSize: root of the projected pixel area at x.
  IrradianceEstimate lookup(const vec3& x, const vec3& normal, const vec3& shadingNormal, float pixelSize) const;
  IrradianceEstimate lookup(const vec3& x, const vec3& normal, float pixelSize) const {
    return lookup(x, normal, normal, pixelSize);
  }
  /// The same for many, to out[0] and on: several times as fast where successive places lie close together.
  /// Records serve so many times wider than they cover, but not beyond disputes, and less where they are
  /// steep; those of `split` and `plain` do not, as published, nor those of `hessian`, of which enough overlap.
  void lookup(std::span<const IrradiancePlace> places, IrradianceEstimate* out, float wider = 1) const;
  const IrradianceRecords& records() const;
  const Bound3& bound() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales

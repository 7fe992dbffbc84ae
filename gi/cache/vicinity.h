// Private to gi/cache: the records that may serve some of the places of a run of lookups, as arrays, so that
// vector instructions compare each place with all of them. Space: that of the cache.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "gi/irradiance_cache.h"
#include "reyes/base/simd.h"

namespace tomales {

/// The limits of how far records serve, for places of one pixel size.
struct Range {
  float least, most;  ///< The clamps R- and R+ of Tabellion and Lamorlette 2004, eq. 3.
  float kappa;        ///< The divisor of radii in eq. 2.
  float pixel;        ///< Root of the projected pixel area at kappa 1.
  float wider;        ///< Greatest factor on a radius (Amendment::Reach).
  float leastCosine;  ///< Least cosine between the normals of a place and of a record that serves it.
  bool fadesBehind;   ///< True if Amendment::Behind is on.

  /// Returns the distance at which the error reaches 1: the denominator of eq. 3 over kappa. The split sphere as it was
  /// published has no limits in pixels.
  float radiusOf(float size) const { return std::max(std::min(size, most), least) / kappa; }
};

/// A record that serves a place, and what its weight depends on.
struct Serving {
  uint32_t record;
  float position;  ///< The distance over the radius; less than 1.
  float angle;     ///< sqrt(1 - n.ni)
  float fades;     ///< A factor on the weight; 0: it does not serve.
};

/// The part of a record that tells where it serves.
struct RecordReach {
  vec3 position, normal;
  float size;  ///< The radius before the size of pixels limits it.
  float limit, steepness, unseen;

  static RecordReach of(const IrradianceRecord& record, float size);
};

/// Returns how a record serves a place.
Serving servingOf(uint32_t record, const RecordReach& reach, const vec3& position, const vec3& normal,
                  const Range& range);

class Vicinity {
 public:
  /// Replaces all records by these. Each lookup finds them in this order.
  template <class SizeOf>
  void assign(const std::vector<uint32_t>& indices, const IrradianceRecords& records, const SizeOf& sizeOf) {
    clear();
    for (const uint32_t i : indices) add(i, RecordReach::of(records[i], sizeOf(records[i])));
  }
  /// Replaces `out` by the records that serve this place.
  void find(const vec3& position, const vec3& normal, const Range& range, std::vector<Serving>& out);

 private:
  void clear();
  void add(uint32_t index, const RecordReach& record);

  std::vector<uint32_t> records_;
  AlignedVector<float> x_, y_, z_, nx_, ny_, nz_, size_, limit_, steepness_, unseen_;
  /// The values of Serving.
  AlignedVector<float> position_, angle_, fades_;
};

}  // namespace tomales

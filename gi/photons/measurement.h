// Private to gi: the irradiance at given points, by photons that are counted where they arrive and never kept (Knaus
// and Zwicker 2011, "Progressive Photon Mapping: A Probabilistic Approach"). Passes of photons are independent of each
// other; the estimate is their mean. Sums are whole numbers, so that they are the same in any order. Space: current.
// Power: W. Threads: count() may be called concurrently with itself alone.
#pragma once
#include <atomic>
#include <memory>
#include <span>

#include "gi/photons.h"

namespace tomales {

struct MeasurementPoint {
  vec3 P, N;     ///< N: unit length, on the side whose light is measured.
  float radius;  ///< Radius of the disk on which photons count, at scale 1.
  float beside;  ///< Greatest distance from the surface to the polygons that photons meet, on either side.
  int bounces;   ///< Photons that have bounced more often (StoredPhoton::bounces) do not count.
};

class PhotonMeasurement {
 public:
  /// `power`: of all photons of a pass together; it fixes the unit of the sums.
  PhotonMeasurement(std::vector<MeasurementPoint> points, double power);

  /// Begins the next pass, in which each disk has `scale` times its radius. One thread calls it.
  void beginPass(float scale);
  void count(std::span<const StoredPhoton> photons);

  vec3 overPi(size_t point) const;  ///< Mean E/pi of the passes.
  /// Returns the expected absolute error of overPi() by noise, all points together, over the mean of overPi(): half the
  /// mean difference of even and odd passes. Negative before there are two passes, or if no photon counted.
  double noise() const;
  size_t size() const { return points_.size(); }

 private:
  /// A cube of the grid: its edge is 2^level.
  struct Cube {
    int level;
    glm::ivec3 at;
    uint64_t name() const;
  };
  struct Entry {
    uint64_t cube;
    uint32_t point;
  };
  float reach(const MeasurementPoint& p) const { return std::sqrt(2.0f) * scale_ * p.radius + p.beside; }
  bool holds(const MeasurementPoint& p, const StoredPhoton& photon) const;
  void build();
  void add(uint32_t point, const vec3& power);
  std::span<const Entry> slotOf(uint64_t cube) const;
  vec3 half(size_t point, size_t parity) const;

  std::vector<MeasurementPoint> points_;
  const double unit_;  ///< Unit of the counted power, in W.
  float scale_ = 0;
  int64_t passes_ = 0;
  std::vector<int> levels_;      ///< The levels that have points.
  std::vector<uint32_t> slots_;  ///< First entry of each slot of the hash table, and the end.
  std::vector<Entry> entries_;   ///< Ordered by slot.
  /// Power over scale^2: for each point that of red, green and blue, of even passes and then of odd ones.
  std::unique_ptr<std::atomic<int64_t>[]> sums_;
};

}  // namespace tomales

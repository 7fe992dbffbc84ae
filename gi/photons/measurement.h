// Private to gi: the irradiance at given points, by photons that are counted where they arrive and kept for one pass
// alone (Knaus and Zwicker 2011, "Progressive Photon Mapping: A Probabilistic Approach"). Passes of photons are
// independent of each other; the estimate is their weighted mean. Sums are whole numbers, so that they are the same in
// any order. Space: current. Power: W. Threads: count() may be called concurrently with itself alone.
#pragma once
#include <array>
#include <memory>
#include <mutex>
#include <span>

#include "gi/photons/arrivals.h"
#include "raytrace/trace.h"

namespace tomales {

struct MeasurementPoint {
  vec3 P, N;     ///< N: unit length, on the side whose light is measured.
  float radius;  ///< Radius of the disk on which photons count, at scale 1.
  float beside;  ///< Greatest distance from the surface to the polygons that photons meet, on either side.
  int bounces;   ///< Photons that have bounced more often (StoredPhoton::bounces) do not count.

  /// Greatest distance along N of what lies on the disk.
  float thickness(float scale) const { return scale * radius + beside; }
  /// Tells whether a photon at `at`, which arrives on the side of the unit normal `facing`, counts.
  bool holds(const vec3& at, const vec3& facing, float scale) const;
};

/// What has been counted, without the points.
struct PhotonSums {
  size_t passes = 0;
  std::array<double, 2> weights{};  ///< Sums of the weights of even and odd passes.
  /// Weighted power over scale^2: for each point that of red, green and blue, of even passes and then of odd ones.
  std::vector<int64_t> power{};
};

class PhotonMeasurement {
 public:
  /// `power`: the total power of the photons of a pass, the same in each pass; it fixes the unit of the sums.
  /// `largestScale`: the largest scale of all passes. Part of the disk of a point near an edge lies on no surface:
  /// `rays` find that part. Without them the whole disk counts as surface.
  PhotonMeasurement(std::vector<MeasurementPoint> points, double power, const RayScene* rays = nullptr,
                    float largestScale = 1);

  /// Begins the next pass, in which each disk has `scale` times its radius. `weight`: the weight of the pass in the
  /// mean; the weights of all passes add up to about 1 at most. One thread calls it.
  void beginPass(float scale, double weight);
  void count(std::span<const StoredPhoton> photons);
  /// Adds what has been counted since the pass began. Uses the pool.
  void endPass();

  vec3 overPi(size_t point) const;  ///< Mean E/pi of the passes.
  /// Returns the expected absolute error of overPi() by noise, all points together, over the mean of overPi(): half the
  /// mean difference of even and odd passes, which should have equal radii and weights. Negative before there are two
  /// passes, or if no photon counted.
  double noise() const;
  size_t size() const { return points_.size(); }
  const PhotonSums& sums() const { return sums_; }
  /// Goes on from sums(), which were those of an equal measurement. Returns false, and stays as it is, if they have
  /// another number of points.
  bool resume(PhotonSums sums);

 private:
  void measure(uint32_t point, const PhotonArrivals& arrivals);
  void cover();
  vec3 half(size_t point, size_t parity) const;

  std::vector<MeasurementPoint> points_;
  double unit_;                  ///< Unit of the counted power, in W.
  std::vector<uint32_t> order_;  ///< The points along Morton's curve.
  const RayScene* rays_;
  std::vector<uint32_t> edges_;  ///< The points whose largest disk lies partly on no surface.
  std::vector<float> covered_;   ///< The part of each point's disk that lies on a surface, at the current scale.
  float scale_ = 0;
  double weight_ = 0;  ///< Weight of the pass that was begun last.
  PhotonSums sums_;
  std::unique_ptr<std::mutex> counting_ = std::make_unique<std::mutex>();
  std::vector<StoredPhoton> counted_;  ///< The photons of this pass.
};

}  // namespace tomales

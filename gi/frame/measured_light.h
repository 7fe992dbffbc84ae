// Private to gi: the light that photons bring to the points at which the frame's shaders ask for indirect light. The
// frame is first shaded without light, to note these points; where rays of mirrors and glass arrive, shaders ask too.
// Then photons are counted at the points. When the frame is shaded, its shaders ask at the same points again.
// Irradiance: E/pi. Space: current.
#pragma once
#include <mutex>
#include <unordered_map>

#include "gi/frame/asked_points.h"
#include "gi/photons/measurement.h"
#include "gi/services.h"
#include "reyes/base/checkpoint.h"
#include "reyes/base/stop.h"

namespace tomales {

struct GiState;

class MeasuredLight {
 public:
  /// Returns true until measure(). Threads: note() may be called concurrently.
  bool isNoting() const { return !measurement_; }
  void note(const MeasurementPoint& point);

  /// Counts passes of photons at what has been noted, until as many as asked for have been sent or the noise is low
  /// enough. `kept` provides what an earlier run has counted and stores what this one counts; it may be null.
  void measure(const RayTools& tools, const PhotonPasses& passes, Checkpoint* kept,
               const std::function<void(float)>& progress, Stats& stats);

  /// Returns E/pi at a point that is equal to a noted one, and 0 at any other. Threads: may be called concurrently.
  vec3 overPi(const MeasurementPoint& point) const;

 private:
  static uint64_t hashOf(const MeasurementPoint& point);

  std::mutex noting_;
  std::unordered_map<uint64_t, uint32_t> index_;  ///< The number of each point, by its hash.
  std::vector<MeasurementPoint> points_;
  std::unique_ptr<PhotonMeasurement> measurement_;
};

/// Notes where shaders ask for indirect light, and counts photons there, if state.passes says how many.
void measureLight(GiState&, const DeepFrame& layout, const TileReader&, const std::function<void(float)>& progress,
                  StopToken stop);
/// Notes the places while measureLight() asks for them, and answers that they are dark. Returns false at any other
/// time.
bool noteMeasured(const GiState&, const AskedPoints&, int bounces, const ShadeContext&, const IndirectResult& out);
/// Adds what has been measured to E, where the eye looks and by mirrors and glass.
void addMeasured(const GiState&, const AskedPoints&, int bounces, const ShadeContext&, const IndirectResult& out);

}  // namespace tomales

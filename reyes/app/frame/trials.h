// Trials in a few buckets of a frame: what error its light has with some settings, and what it costs.
#pragma once
#include "reyes/app/frame/error_model.h"
#include "reyes/app/frame/frame_job.h"

namespace tomales {

/// Rays are the same in every run, seconds are those of this machine now.
enum class CostUnit { Rays, Seconds };

struct TrialPlan {
  CostUnit unit = CostUnit::Rays;
  bool isBrief = false;  ///< A quarter of the rays, and fewer pixels: the frame has little time.
  uint32_t seed = 0;     ///< Decides which buckets and pixels.
};

struct TrialsResult {
  ErrorModel model;
  size_t buckets = 0, ofBuckets = 0;  ///< Those that were tried, and all that see something.
  double audit_s = 0;                 ///< What an audit of the frame may take.
};

/// Lights and audits the buckets two or three times. What is gathered stays with the job until its next setQuality().
TrialsResult makeTrials(FrameJob& job, const DeepFrame& layout, const TileReader& tiles, const TrialPlan& plan,
                        Stats& stats);

}  // namespace tomales

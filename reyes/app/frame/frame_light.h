// The light of a frame that is hidden: it is gathered, and its error is measured, as the command line asks.
#pragma once
#include "reyes/app/frame/audit.h"
#include "reyes/app/frame/frame_job.h"

namespace tomales {

/// The job and the layout outlive it.
class FrameLight {
 public:
  FrameLight(FrameJob& job, const DeepFrame& layout, TileReader tiles)
      : job_(job), layout_(layout), tiles_(std::move(tiles)) {}

  FrameJob& job() const { return job_; }
  const DeepFrame& layout() const { return layout_; }
  const TileReader& tiles() const { return tiles_; }

  /// Gathers what the picture needs, and measures and reports its error. The program chooses the settings itself if the
  /// command line names an error to reach, or a time. `gathers`: false if records are given.
  void make(bool gathers);

  // The steps of make(), which may be repeated.
  /// Gathers, warns of what the records show, and keeps light for later frames if the command line asks for it.
  void gather();
  /// The first part of gather(), for records that may be gathered again. The viewer shows what is gathered so far.
  void gatherShown();
  /// The rest of gather(), for the records that stay.
  void endGather();
  /// Gathers in all tiles that there are, and shows nothing.
  void gatherRecords() { gatherRecords({}, {}); }
  /// Returns the settings that `--audit` asks for, at pixels that this seed decides.
  AuditSettings auditSettings(uint32_t seed) const;
  /// Measures the error that the picture will have. The tiles are read once. Errors below `matters` may be hidden by
  /// the noise of the audit.
  AuditReport audit(uint32_t seed, const ErrorTarget& matters = {});
  /// Reports the audit in a message, in the headers of the Displays, and in the statistics.
  void tellAudit(const AuditReport& report);

 private:
  void gatherRecords(const std::function<void(float)>& progress, const std::function<void(int)>& covered);
  bool needsGather() const { return job_.gathers() || job_.counts(); }
  bool isSteered() const;

  FrameJob& job_;
  const DeepFrame& layout_;
  const TileReader tiles_;
};

/// Writes a coarse picture of the whole frame beside the first Display's file, in direct light, for those who stop
/// before it is finished. writePicture() removes it when the Displays are written.
void writeSketch(const FrameLight& light);
/// Warns if records that stand in for a gather pass were made without one. `file` is where they come from.
void checkRecords(const GiSettings& gathered, const std::string& file, const FrameJob& job, Log& log);

}  // namespace tomales

// The time and other figures of a run and its frames, for --stats, --profile-shaders, -v and --log.
#pragma once
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "reyes/app/settings.h"
#include "reyes/base/log.h"
#include "reyes/base/stats.h"

namespace tomales {

/// The figures that --stats writes.
struct RunFigures {
  std::optional<int> frame;        ///< Empty before the first frame.
  double wall_s = 0, cpu_s = 0;    ///< Times of the whole process.
  int64_t peak_bytes = 0;          ///< Most resident memory.
  std::vector<LogEntry> messages;  ///< Messages reported in that time.
};

class RunReport {
 public:
  /// Opens --log, and writes there what runs. `log` and `settings` outlive it.
  RunReport(const RenderSettings& settings, Log& log);

  /// Returns the counters of the frame that is being made, or of the run where --stats names one file for all frames.
  /// The reference stays.
  Stats& stats() { return *stats_; }
  /// Tells the number of the frame that is being made. The scene that was read before belongs to it.
  void begin(int frame) { frame_ = frame; }
  /// Writes the figures so far, if --stats names one file for a frame or for all.
  void flush();
  /// Ends the frame: reports the files that it has written and the time that it has taken, and writes its figures.
  void end(const SourceLoc& where);
  /// Leaves out the reading of a frame that is not rendered.
  void skip();
  /// Writes the figures of the whole run.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void openLog();
  bool appends() const;
  bool isPerFrame() const;
  std::string statsFile() const;
  void write();
  RunFigures figures() const;
  void startFrame();
  void startFigures();
  void fillHeaders() const;
  void say(const SourceLoc& where);

  const RenderSettings& settings_;
  Log& log_;
  std::optional<Stats> stats_;
  std::optional<int> frame_;
  Clock::time_point start_, frameStart_;  ///< Beginnings of the figures and of the frame.
  double cpuStart_ = 0, frameCpuStart_ = 0;
  int64_t peak_ = 0;  ///< Peak of the frames before, in bytes.
  size_t outputsSaid_ = 0;
  std::vector<LogEntry> before_;  ///< Messages that the figures leave out.
};

}  // namespace tomales

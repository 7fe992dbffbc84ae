// The progress of a frame, of which each stage has a share.
#pragma once
#include <functional>
#include <utility>

#include "reyes/app/watch/progress.h"

namespace tomales {

class FrameMeter {
 public:
  using Progress = std::function<void(float)>;  ///< Gets the share of a stage that is done.

  FrameMeter(bool wanted, ProgressWatcher watcher) : meter_(wanted, "preparing", std::move(watcher)) {}

  /// Sets the shares at which hiding and gathering are finished, for commands that leave out a stage.
  void setShares(float hidden, float gathered) {
    hidden_ = hidden;
    gathered_ = gathered;
  }
  /// Begins a stage whose share nobody knows.
  void begin(const char* stage) { meter_.begin(stage); }
  Progress hiding(bool beforeLight) { return meter_.pass("hiding", 0, beforeLight ? hidden_ : gathered_); }
  Progress makingMaps() { return meter_.pass("making maps of light", hidden_, mapsMade()); }
  Progress gathering(bool afterMaps) { return meter_.pass("gathering", afterMaps ? mapsMade() : hidden_, gathered_); }
  Progress shading() { return meter_.pass("shading", gathered_, 1); }
  Progress hidingAndShading() { return meter_.pass("hiding and shading", 0, 1); }
  void finish() { meter_.finish(); }

 private:
  float mapsMade() const { return 0.5f * (hidden_ + gathered_); }

  ProgressMeter meter_;
  float hidden_ = 0.3f, gathered_ = 0.7f;
};

}  // namespace tomales

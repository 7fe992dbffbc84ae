// Private to gi: makes records at many points in parallel, slice by slice, and takes over the slices that an
// interrupted run has made (Checkpoint). All slices of a frame have the same order in every run, so their number names
// them. Space: that of the points.
#pragma once
#include <functional>
#include <vector>

#include "gi/gather.h"
#include "reyes/base/checkpoint.h"
#include "reyes/base/stop.h"

namespace tomales {

/// Records, and the bright light that they have found if it was searched.
struct RecordSlice {
  std::vector<IrradianceRecord> records;
  std::vector<BrightFind> finds;
};

struct RecordMaking {
  bool findsLight = false;  ///< `gather` gets a place for the bright light.
  std::function<IrradianceRecord(size_t point, BrightFind* find)> gather;  ///< Called by any thread.
  StopToken stop;
  std::function<void(float)> progress{};  ///< May be empty. Called by any thread, one at a time, with growing shares.
};

class RecordSlices {
 public:
  /// kept: may be null.
  RecordSlices(Checkpoint* kept, KeptKind kind) : kept_(kept), kind_(kind) {}
  /// Makes a record at every point, in the order of the points. Returns the number of records made, which belong to the
  /// first points. It is less than the number of points if it was stopped.
  size_t make(const std::vector<GatherPoint>& points, const RecordMaking& making, RecordSlice& out);

 private:
  Checkpoint* kept_;
  KeptKind kind_;
  size_t made_ = 0;  ///< Slices so far.
};

}  // namespace tomales

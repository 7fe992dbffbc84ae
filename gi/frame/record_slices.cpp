#include "gi/frame/record_slices.h"

#include <algorithm>
#include <mutex>
#include <span>

#include "gi/frame/record_fields.h"
#include "reyes/base/parallel.h"

namespace tomales {
namespace {

/// Points whose records are stored together. An interruption loses no more of a thread's work than these.
constexpr size_t kPointsPerSlice = 16;

struct StoredSlice {
  uint64_t points = 0;  ///< Sum of the points that the records were made at.
  RecordSlice slice;
};

template <class A>
void fields(A& a, StoredSlice& x) {
  each(a, x.points, x.slice.records, x.slice.finds);
}

}  // namespace

size_t RecordSlices::make(const std::vector<GatherPoint>& points, const RecordMaking& making, RecordSlice& out) {
  out.records.resize(points.size());
  out.finds.resize(making.findsLight ? points.size() : 0);
  const size_t slices = (points.size() + kPointsPerSlice - 1) / kPointsPerSlice, firstName = made_;
  made_ += slices;
  size_t done = 0;
  std::mutex reporting;  // it guards `done`
  std::vector<uint8_t> whole(slices, 0);
  const auto makeSlice = [&](size_t s) {
    const size_t begin = s * kPointsPerSlice, end = std::min(begin + kPointsPerSlice, points.size());
    const std::vector<GatherPoint> here(points.begin() + static_cast<std::ptrdiff_t>(begin),
                                        points.begin() + static_cast<std::ptrdiff_t>(end));
    StoredSlice stored{contentSum(here), {}};
    RecordSlice& slice = stored.slice;
    StoredSlice before;
    if (kept_ && kept_->take(kind_, firstName + s, before) && before.points == stored.points &&
        before.slice.records.size() == here.size() &&
        before.slice.finds.size() == (making.findsLight ? here.size() : 0)) {
      slice = std::move(before.slice);
    } else {
      slice.records.resize(here.size());
      slice.finds.resize(making.findsLight ? here.size() : 0);
      for (size_t k = 0; k < here.size(); ++k) {
        slice.records[k] = making.gather(begin + k, making.findsLight ? &slice.finds[k] : nullptr);
        if (making.stop.requested()) return;
      }
      if (kept_) kept_->keep(kind_, firstName + s, stored);
    }
    std::ranges::move(slice.records, out.records.begin() + static_cast<std::ptrdiff_t>(begin));
    std::ranges::move(slice.finds,
                      out.finds.begin() + static_cast<std::ptrdiff_t>(making.findsLight ? begin : size_t{0}));
    whole[s] = 1;
  };
  parallelFor(slices, 1, [&](size_t s, size_t) {
    if (making.stop.requested()) return;
    makeSlice(s);
    const std::lock_guard lock(reporting);
    if (making.progress) making.progress(static_cast<float>(++done) / static_cast<float>(slices));
  });
  const auto missing = static_cast<size_t>(std::ranges::find(whole, 0) - whole.begin());
  return std::min(missing * kPointsPerSlice, points.size());
}

}  // namespace tomales

#include "reyes/light_list.h"

#include <algorithm>
#include <utility>

namespace tomales {

size_t LightList::size() const {
  size_t out = 0;
  for (const Run& run : runs_) out += static_cast<size_t>(run.end - run.first);
  return out;
}

bool LightList::contains(int light) const {
  return std::any_of(runs_.begin(), runs_.end(),
                     [light](const Run& run) { return light >= run.first && light < run.end; });
}

bool LightList::begins(const LightList& longer) const {
  if (empty()) return true;
  const size_t whole = runs_.size() - 1;
  return longer.runs_.size() > whole && std::equal(runs_.begin(), runs_.end() - 1, longer.runs_.begin()) &&
         runs_[whole].first == longer.runs_[whole].first && runs_[whole].end <= longer.runs_[whole].end;
}

void LightList::append(Run run) {
  if (run.first >= run.end) return;
  if (!runs_.empty() && runs_.back().end == run.first)
    runs_.back().end = run.end;
  else
    runs_.push_back(run);
}

void LightList::switchOn(int light) {
  switchOff(light);
  add(light);
}

void LightList::switchOff(int light) {
  if (!contains(light)) return;
  for (const Run& run : std::exchange(runs_, {})) {
    append({run.first, std::min(run.end, light)});
    append({std::max(run.first, light + 1), run.end});
  }
}

LightList LightList::among(const LightList& ascending) const {
  LightList out;
  const auto endsBefore = [](int light, const Run& run) { return light < run.end; };
  for (const Run& run : runs_) {
    auto other = std::upper_bound(ascending.runs_.begin(), ascending.runs_.end(), run.first, endsBefore);
    for (; other != ascending.runs_.end() && other->first < run.end; ++other)
      out.append({std::max(run.first, other->first), std::min(run.end, other->end)});
  }
  return out;
}

}  // namespace tomales

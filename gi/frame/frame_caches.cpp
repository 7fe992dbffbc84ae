#include "gi/frame/frame_caches.h"

#include <algorithm>

#include "gi/frame/cache_keys.h"
#include "gi/frame/frame_survey.h"
#include "gi/frame/hemisphere_queries.h"

namespace tomales {
namespace {

/// Returns the keys of the caches that groups ask for, each with its group.
std::vector<std::pair<size_t, CacheKey>> keysOf(const GiState& state) {
  std::vector<std::pair<size_t, CacheKey>> keys;
  for (size_t g = 0; g < state.scene.groups.size(); ++g) {
    const int group = static_cast<int>(g);
    const IndirectQuery* query = state.shading.group(group).indirectQuery();
    const Attributes& attributes = *state.scene.groups[g].attributes;
    if (attributes.matte || attributes.volume) continue;
    for (const HemisphereQuery& asked : state.hemispheresAsked[g])
      keys.emplace_back(g, cacheKeyFor(state, group, asked));
    if (!query || !attributes.indirect.receive || !interpolatesIndirect(state)) continue;
    const CacheKey key = cacheKeyFor(state, group, *query);
    if (key.cache.kappa < kInfinity) keys.emplace_back(g, key);
  }
  return keys;
}

}  // namespace

bool FrameCaches::prepare(const DeepFrame& layout, const TileReader& tiles, StopToken stop) {
  ofGroups_.assign(state_.scene.groups.size(), {});
  learnHemisphereQueries(state_, layout, tiles, stop);
  const std::vector<std::pair<size_t, CacheKey>> keys = keysOf(state_);
  if (keys.empty()) return false;
  const FrameSurvey survey = surveyOf(layout, tiles, ofGroups_.size(), stop);
  for (const auto& [group, key] : keys) {
    size_t c = 0;
    while (c < state_.caches.size() && !(state_.caches[c].key == key)) ++c;
    if (c == state_.caches.size()) state_.caches.push_back({key, IrradianceCache(survey.bound, key.cache)});
    ofGroups_[group].push_back(c);
    frames_.resize(state_.caches.size());
    frames_[c] += survey.seenOfGroup[group];
  }
  frames_.resize(state_.caches.size());
  return state_.anew || forgetKnown();
}

// Removes the caches that have been gathered for this very frame: points that disagree after the last phase would add
// records each time. Returns false if no cache is left.
bool FrameCaches::forgetKnown() {
  bool left = false;
  for (std::vector<size_t>& caches : ofGroups_) {
    std::erase_if(caches, [&](size_t c) { return !isNew(c); });
    left |= !caches.empty();
  }
  return left;
}

void FrameCaches::rememberFrame() {
  for (const std::vector<size_t>& caches : ofGroups_)
    for (const size_t c : caches)
      if (isNew(c)) state_.caches[c].frames.push_back(frames_[c]);
}

}  // namespace tomales

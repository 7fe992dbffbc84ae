#include "reyes/frame/hide_warnings.h"

#include <fmt/format.h>

#include <algorithm>

namespace tomales {
namespace {

constexpr int kFew_px = 12;          // A crease covers fewer pixels by chance.
constexpr int64_t kFewFacets = 12;   // Fewer facets are not judged.
constexpr double kMostTurned = 0.5;  // Share of the visible facets.

}  // namespace

HideWarnings::Site HideWarnings::siteOf(const Scene& scene, int object) {
  const Object& o = scene.objects[static_cast<size_t>(object)];
  return {o.where, objectName(o)};
}

void HideWarnings::add(const HideDiagnostics& bucket, const Scene& scene) {
  if (bucket.samePlaces.empty() && bucket.turns.empty()) return;
  const std::lock_guard lock(mutex_);
  for (const auto& [pair, pixels] : bucket.samePlaces) {
    auto sites = std::pair(siteOf(scene, pair.first), siteOf(scene, pair.second));
    if (sites.second < sites.first) std::swap(sites.first, sites.second);
    samePlaces_[sites] += pixels;
  }
  for (const auto& [object, turns] : bucket.turns) {
    all_.turned += turns.turned;
    all_.all += turns.all;
    if (turns.turned > 0) turned_[siteOf(scene, object)] += turns.turned;
  }
}

void HideWarnings::report(Log& log) const {
  for (const auto& [sites, pixels] : samePlaces_) {
    if (pixels < kFew_px) continue;
    log.report(Severity::Warning, "hide-coincident", sites.second.where,
               fmt::format("{} lies where {} does, as far as depths can tell: which of them is seen is chance; move "
                           "them apart or leave one out",
                           sites.second.name, sites.first.name));
  }
  if (all_.all < kFewFacets || static_cast<double>(all_.turned) <= kMostTurned * static_cast<double>(all_.all)) return;
  const auto worst = std::max_element(turned_.begin(), turned_.end(),
                                      [](const auto& a, const auto& b) { return a.second < b.second; });
  log.report(Severity::Warning, "dice-turned", worst->first.where,
             fmt::format("{}: most micropolygons turn by 23 degrees or more, so that what is round looks like a "
                         "polyhedron and loses some of its size (ShadingRate, --shading-rate)",
                         worst->first.name));
}

}  // namespace tomales

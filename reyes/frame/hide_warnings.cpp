#include "reyes/frame/hide_warnings.h"

#include <fmt/format.h>

namespace tomales {
namespace {

constexpr int kFew_px = 12;           // where a crease is met by chance
constexpr int64_t kFewFacets = 12;    // show nothing
constexpr double kMostTurned = 0.5;   // of what is visible

}  // namespace

void HideWarnings::add(const HideDoubts& bucket) {
  if (bucket.samePlaces.empty() && bucket.turns.empty()) return;
  const std::lock_guard lock(mutex_);
  for (const auto& [pair, pixels] : bucket.samePlaces) sum_.samePlaces[pair] += pixels;
  for (const auto& [group, turns] : bucket.turns) {
    HideDoubts::Turns& sum = sum_.turns[group];
    sum.turned += turns.turned, sum.all += turns.all;
  }
}

void HideWarnings::report(const Scene& scene, Log& log) const {
  const auto objectOf = [&](int o) -> const Object& { return scene.objects[static_cast<size_t>(o)]; };
  for (const auto& [pair, pixels] : sum_.samePlaces) {
    if (pixels < kFew_px) continue;
    const Object &first = objectOf(pair.first), &second = objectOf(pair.second);
    log.report(Severity::Warning, "hide-coincident", second.where,
               fmt::format("{} lies where {} does, as far as depths can tell: which of them is seen is chance; move them apart or leave one out", objectName(second),
                           objectName(first)));
  }
  HideDoubts::Turns all;
  int worst = -1;
  for (const auto& [group, turns] : sum_.turns) {
    all.turned += turns.turned, all.all += turns.all;
    if (turns.turned > 0 && (worst < 0 || turns.turned > sum_.turns.at(worst).turned)) worst = group;
  }
  if (worst < 0 || all.all < kFewFacets || static_cast<double>(all.turned) <= kMostTurned * static_cast<double>(all.all)) return;
  const int example = scene.groups[static_cast<size_t>(worst)].exampleObject;
  const std::string name = example < 0 ? "the picture" : objectName(objectOf(example));
  log.report(Severity::Warning, "dice-turned", example < 0 ? SourceLoc{} : objectOf(example).where,
             fmt::format("{}: most micropolygons turn by 23 degrees or more, so that what is round looks like a polyhedron and loses some of its size (ShadingRate, --shading-rate)", name));
}

}  // namespace tomales

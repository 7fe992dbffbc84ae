// occlusion() from records as in the irradiance cache, which hold the uncovered share of the hemisphere instead of
// light.
#include "gi/frame/state.h"
#include "reyes/base/parallel.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

/// A visible point at which the shaders of its group are run to learn their queries.
struct ExamplePoint {
  uint32_t order = ~0U;  ///< The point with the least number of its group is taken, whatever the tiles are.
  size_t tile = ~size_t{0};
  int batch = 0, point = 0;
  bool operator<(const ExamplePoint& o) const { return order != o.order ? order < o.order : tile < o.tile; }
};

std::vector<ExamplePoint> examplePointsOf(const GiState& state, const DeepFrame& layout, const TileReader& tiles,
                                          const std::atomic<bool>* cancelled) {
  std::vector<ExamplePoint> examplePoints(state.scene.groups.size());
  std::mutex merging;
  parallelFor(layout.tileCount(), 1, [&](size_t t, size_t) {
    const auto tile = cancelled && cancelled->load(std::memory_order_relaxed) ? nullptr : tiles(t);
    if (!tile) return;
    for (size_t b = 0; b < tile->batches.size(); ++b) {
      const ShadePoints& batch = tile->batches[b];
      if (!state.shading.asksOcclusion(batch.group())) continue;
      ExamplePoint best;
      for (int i = 0; i < batch.count(); ++i)
        best = std::min(best, ExamplePoint{hash32(batch.key(i)), t, static_cast<int>(b), i});
      const std::lock_guard lock(merging);
      ExamplePoint& known = examplePoints[static_cast<size_t>(batch.group())];
      known = std::min(known, best);
    }
  });
  return examplePoints;
}

}  // namespace

bool keepsOcclusion(const GiSettings& settings) { return settings.mode != GiMode::Reference && settings.maxError != 0; }

void learnOcclusionQueries(GiState& state, const DeepFrame& layout, const TileReader& tiles,
                           const std::atomic<bool>* cancelled) {
  state.occlusionAsked.assign(state.scene.groups.size(), {});
  bool any = false;
  for (size_t g = 0; g < state.scene.groups.size(); ++g) any |= state.shading.asksOcclusion(static_cast<int>(g));
  if (!any || !keepsOcclusion(state.settings)) return;
  std::vector<std::vector<ExamplePoint>> ofTile(layout.tileCount());
  for (const ExamplePoint& s : examplePointsOf(state, layout, tiles, cancelled))
    if (s.tile < ofTile.size()) ofTile[s.tile].push_back(s);
  ShadeContext context;
  context.rehearsal = true;
  context.indirect = false;
  context.seed = state.settings.seed;
  parallelFor(ofTile.size(), 1, [&](size_t t, size_t) {
    const auto tile = ofTile[t].empty() ? nullptr : tiles(t);
    for (const ExamplePoint& s : tile ? ofTile[t] : std::vector<ExamplePoint>{}) {
      const ShadePoints& batch = tile->batches[static_cast<size_t>(s.batch)];
      ShadePoints one(batch.group(), batch.primvarFloats(), batch.hasSteps());
      one.assign(batch, s.point, s.point + 1);
      ShadedPoints out;
      state.shading.shade(one, context, out);
    }
  });
}

GatherPlan planFor(const GiState& state, int group, const OcclusionQuery& query) {
  GatherPlan plan;
  plan.cache.errorFunction = ErrorFunction::Hessian;
  plan.cache.maxPixels = state.scene.groups[static_cast<size_t>(group)].attributes->irradianceMaxPixelDist.value_or(
      infoOf(ErrorFunction::Hessian).maxPixels);
  plan.gather.curvature = true;
  plan.gather.samples = query.samples;
  plan.gather.maxDistance = query.maxDistance;
  plan.gather.seed = state.settings.seed;
  plan.gather.occlusion = query;
  return plan;
}

bool interpolateOcclusion(const GiState& state, const ShadePoints& points, const uint8_t* active, TmConstVec3 N,
                          const OcclusionQuery& query, const ShadeContext& context, float* covered) {
  if (!keepsOcclusion(state.settings)) return false;
  if (context.rehearsal) {
    auto& asked = state.occlusionAsked[static_cast<size_t>(points.group())];
    if (std::find(asked.begin(), asked.end(), query) == asked.end()) asked.push_back(query);
    return true;
  }
  const GatherPlan plan = planFor(state, points.group(), query);
  const auto prepared =
      std::find_if(state.caches.begin(), state.caches.end(), [&](const PreparedCache& c) { return c.plan == plan; });
  if (prepared == state.caches.end()) return false;
  const GatherPlaces places(state, points);
  const BatchLookup found = lookUp(state, &*prepared, places, points, active, N, context);
  for (size_t k = 0; k < found.points.size(); ++k) {
    const int i = found.points[k];
    float open = found.known[k].E.x;
    if (!(found.known[k].weight > 0)) {
      GatherPoint point = places.at(i);
      point.normal = found.at[k].shadingNormal;
      open = gatherOrRecall(state, point, plan.gather, context.answers).E.x;
    }
    covered[i] = std::clamp(1 - open, 0.0f, 1.0f);
  }
  return true;
}

}  // namespace tomales

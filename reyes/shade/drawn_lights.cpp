// Lights of which each point draws a few (light_sets.h). A sample of a set is one run of the shader, with the numbers
// of a different light at each point.
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/shade/illuminate.h"
#include "reyes/shade/light_runs.h"
#include "reyes/shade/parameter_values.h"

namespace tomales {
namespace {

constexpr uint32_t kNoLight = ~0U;
/// A lamp with geometry uses this many of its samples on average at most: near lamps use all of theirs, far ones one.
constexpr int kSamplesOfLight = 2;
/// Hits of gather rays draw one lamp where points that the eye sees draw this many, because many hits make one record.
constexpr int kShareAtHits = 8;
constexpr int kLeastInBranch = 4;

/// The lamp of each point in one run.
struct LightOfPoint {
  uint32_t light = kNoLight;
  int sample = 0, samples = 1;
  float expected = 1;  ///< Mean number of samples that the point draws of this lamp.
};

int mostDrawn(const Batch& batch, const BoundLight& light) {
  const int lights = shareOfBranch(batch.scene.lightCut, std::min(batch.scene.lightCut, kLeastInBranch), batch.context),
            here = batch.context.kind == RayKind::Diffuse ? std::max(1, lights / kShareAtHits) : lights;
  return std::min(here * std::min(samplesOf(light, batch), kSamplesOfLight), kMostLightSamples);
}

TmConstVec3 from(TmConstVec3 v, int i) { return {v.x + i, v.y + i, v.z + i}; }
TmVec3 from(TmVec3 v, int i) { return {v.x + i, v.y + i, v.z + i}; }
EmitterPoints from(const EmitterPoints& p, int i) { return {from(p.P, i), from(p.N, i), p.pdf + i, p.meetPdf + i}; }

LightReceiver receiverOf(const Batch& batch, int i, uint32_t lights) {
  return {batch.points->position(i), batch.points->inAir() ? vec3(0.0f) : batch.points->facingNormal(i), lights};
}

/// Draws a lamp of each cluster of each point.
std::vector<DrawnLight> drawnOf(const Batch& batch, const LightsOfSet& some, const LightCuts& cuts) {
  const size_t n = cuts.clusters.size();
  std::vector<uint32_t> index(n), stream(n);
  for (int i = 0; i < batch.points->count(); ++i) {
    const SampleName name = batch.points->name(i);
    for (uint32_t k = cuts.first[static_cast<size_t>(i)]; k < cuts.first[static_cast<size_t>(i) + 1]; ++k) {
      index[k] = name.sequence;
      stream[k] = hashCombine(name.key, randomStream("lamp"), cuts.clusters[k].node, batch.context.seed);
    }
  }
  std::vector<float> xi(n);
  sobol1(index, stream, xi);
  std::vector<DrawnLight> out(n);
  for (int i = 0; i < batch.points->count(); ++i) {
    const std::span<const LightCluster> clusters = cuts.at(i);
    const size_t first = cuts.first[static_cast<size_t>(i)];
    if (!clusters.empty())
      some.set->tree.draw(receiverOf(batch, i, some.count), clusters, std::span(xi).subspan(first, clusters.size()),
                          std::span(out).subspan(first, clusters.size()));
  }
  return out;
}

/// Distributes the lamps of all points over runs of the shader.
class Drawing {
 public:
  Drawing(const Batch& batch, const LightsOfSet& some, const LightCuts& cuts)
      : cuts_(cuts), drawn_(drawnOf(batch, some, cuts)), at_(cuts.first.size() - 1), next_(cuts.first) {
    for (size_t i = 0; i < at_.size(); ++i) {
      int samples = 0;
      for (const LightCluster& c : cuts.at(static_cast<int>(i))) samples += c.samples;
      runs_ = std::max(runs_, samples);
    }
  }
  int runs() const { return runs_; }

  const std::vector<LightOfPoint>& next() {
    for (size_t i = 0; i < at_.size(); ++i) {
      LightOfPoint& l = at_[i];
      if (l.light != kNoLight && ++l.sample < l.samples) continue;
      l.light = kNoLight;
      if (next_[i] == cuts_.first[i + 1]) continue;
      const DrawnLight& drawn = drawn_[next_[i]];
      const int samples = cuts_.clusters[next_[i]++].samples;
      l = {drawn.light, 0, samples, drawn.probability * static_cast<float>(samples)};
    }
    return at_;
  }

 private:
  const LightCuts& cuts_;
  std::vector<DrawnLight> drawn_;  ///< Of each cluster.
  std::vector<LightOfPoint> at_;
  std::vector<uint32_t> next_;  ///< The cluster that each point takes next.
  int runs_ = 0;
};

/// Returns the parameters of the light, with the numbers of each point's lamp where lamps differ.
std::vector<TmValue> paramsOf(Batch& batch, const LightSet& drawn, const std::vector<LightOfPoint>& at) {
  std::vector<TmValue> out = drawn.lights[0]->bound->values;
  std::vector<float*> columns;
  for (const int p : drawn.varying) {
    TmValue& value = out[static_cast<size_t>(p)];
    for (int c = 0; c < floatsOf(typeOf(drawn.lights[0]->bound->shader->params[p])); ++c)
      value.c[c] = columns.emplace_back(batch.arena.floats(batch.tm.count));
    value.step = 1;
  }
  for (int i = 0; i < batch.tm.count; ++i) {
    const uint32_t light = at[static_cast<size_t>(i) % at.size()].light;
    const float* numbers = drawn.numbers.data() + columns.size() * (light == kNoLight ? 0 : light);
    for (float* column : columns) column[i] = *numbers++;
  }
  return out;
}

/// Returns the vectors to just before the points on the emitters.
TmVec3 beforeEmitters(Batch& batch, const LightSet& drawn, const std::vector<LightOfPoint>& at, const TmGrid& g) {
  const TmVec3 toward = batch.arena.vec3(g.count);
  for (int i = 0; i < g.count; ++i) {
    const uint32_t light = at[static_cast<size_t>(i)].light;
    vec3 path = get(g.L, i);
    if (light != kNoLight) path += batch.scene.services->emitterReach(drawn.lights[light]->index) * get(g.Nl, i);
    set(toward, i, path);
  }
  return toward;
}

/// Samples for each point a position on the lamp that it has drawn.
void sampleEmitters(Batch& batch, const LightSet& drawn, const std::vector<LightOfPoint>& at, TmGrid& g,
                    const EmitterPoints& points) {
  float *xi0 = batch.arena.floats(g.count), *xi1 = batch.arena.floats(g.count);
  g.xi0 = xi0;
  g.xi1 = xi1;
  for (int i = 0; i < g.count; ++i) {
    const LightOfPoint& l = at[static_cast<size_t>(i)];
    if (!g.active[i]) continue;
    const BoundLight& light = *drawn.lights[l.light];
    const vec2 xi = sampleAt(batch, light, i, l.sample, l.samples);
    xi0[i] = xi.x;
    xi1[i] = xi.y;
    batch.scene.services->sampleEmitter(light.index, 1, from(view(g.P), i), xi0 + i, xi1 + i, from(points, i));
    points.pdf[i] *= l.expected;
    points.meetPdf[i] *= l.expected;
    set(g.L, i, get(g.Pl, i) - get(g.P, i));
  }
}

}  // namespace

const LightCuts& Lights::cutsOf(Batch& batch, const LightsOfSet& some) {
  const LightSet& set = *some.set;
  const auto [it, isNew] = cuts_.try_emplace(&set);
  LightCuts& cuts = it->second;
  if (!isNew) return cuts;
  const BoundLight& light = *set.lights[0];
  const int most = mostDrawn(batch, light), perLight = light.can(TM_LIGHT_AREA) ? samplesOf(light, batch) : 1;
  std::vector<LightCluster> cut;
  cuts.first.push_back(0);
  for (int i = 0; i < batch.points->count(); ++i) {
    cut.clear();
    if (batch.tm.active[i]) set.tree.cut(receiverOf(batch, i, some.count), most, perLight, cut);
    cuts.clusters.insert(cuts.clusters.end(), cut.begin(), cut.end());
    cuts.first.push_back(static_cast<uint32_t>(cuts.clusters.size()));
  }
  return cuts;
}

void Lights::evaluateDrawn(Batch& batch, const LightsOfSet& some) {
  const LightSet& drawn = *some.set;
  const BoundLight& first = *drawn.lights[0];
  const bool area = first.can(TM_LIGHT_AREA);
  Drawing drawing(batch, some, cutsOf(batch, some));
  for (int run = 0; run < drawing.runs(); ++run) {
    TmGrid g = lightGrid(batch, first);
    const std::vector<LightOfPoint>& at = drawing.next();
    uint8_t* has = batch.arena.bytes(g.count);
    for (int i = 0; i < g.count; ++i) has[i] = at[static_cast<size_t>(i)].light != kNoLight;
    g.active = has;
    openOutputs(batch, *first.bound, params_.emplace_back(paramsOf(batch, drawn, at)));
    tell(batch, *first.bound, params_.back());
    g.params = params_.back().data();
    g.sample = 0;
    g.samples = 1;
    EmitterPoints points{};
    if (area) {
      points = emitterPoints(batch, first, g);
      sampleEmitters(batch, drawn, at, g, points);
    }
    if (!batch.run(*first.bound, g)) return;
    darkenNonFinite(batch, *first.bound, g);
    if (area) radianceToSample(g, points.pdf);
    for (int i = 0; i < g.count; ++i) {
      if (!area) set(g.Cl, i, get(g.Cl, i) / at[static_cast<size_t>(i)].expected);
      if (has[i]) continue;
      set(g.L, i, batch.points->facingNormal(i));
      set(g.Cl, i, vec3(0.0f));
    }
    LightSample sample = sampleOf(batch, first, g, {false, run, drawing.runs()}, run);
    sample.pdf = points.meetPdf;
    sample.drawn = true;
    if (first.shadows && batch.scene.services) {
      if (area) sample.toward = beforeEmitters(batch, drawn, at, g);
      sample.pending = has;
    }
    samples_.push_back(sample);
  }
}

void Lights::alongDrawn(Batch& batch, const LightsOfSet& some, const LobeDirections& lobe, TmVec3 Cl) {
  const LightSet& drawn = *some.set;
  const BoundLight& first = *drawn.lights[0];
  const LightCuts& cuts = cutsOf(batch, some);
  const ShadeServices& services = *batch.scene.services;
  const int n = batch.points->count();
  std::vector<std::vector<uint32_t>> near(static_cast<size_t>(n));
  size_t runs = 0;
  for (int i = 0; i < n; ++i) {
    if (!batch.tm.active[i] || !(lobe.pdf[i] > 0)) continue;
    std::vector<uint32_t>& met = near[static_cast<size_t>(i)];
    drawn.tree.meet(batch.points->position(i), get(lobe.L, i), met);
    std::erase_if(met, [&](uint32_t light) { return light >= some.count; });
    runs = std::max(runs, met.size());
  }
  for (size_t run = 0; run < runs; ++run) {
    TmGrid g = lightGrid(batch, first);
    g.sample = lobe.sample;
    g.samples = lobe.samples;
    uint8_t* met = batch.arena.bytes(g.count);
    const EmitterPoints points = emitterPoints(batch, first, g);
    std::vector<LightOfPoint> at(static_cast<size_t>(n));
    bool any = false;
    for (int i = 0; i < n; ++i) {
      if (near[static_cast<size_t>(i)].size() <= run) continue;
      const uint32_t light = near[static_cast<size_t>(i)][run];
      services.meetEmitter(drawn.lights[light]->index, 1, from(view(g.P), i), from(lobe.L, i), from(points, i));
      if (!(points.pdf[i] > 0)) continue;
      met[i] = 1;
      any = true;
      at[static_cast<size_t>(i)].light = light;
      set(g.L, i, get(g.Pl, i) - get(g.P, i));
      const float a = points.pdf[i] * drawn.tree.expected(receiverOf(batch, i, some.count), cuts.at(i), light),
                  b = static_cast<float>(lobe.samples) * lobe.pdf[i];
      points.pdf[i] = (a * a + b * b) / b;  // b over its weight by the power heuristic
    }
    if (!any) continue;
    g.active = met;
    std::vector<TmValue> params = paramsOf(batch, drawn, at);
    openOutputs(batch, *first.bound, params);
    g.params = params.data();
    if (!batch.run(*first.bound, g)) return;
    // No point meets more lamps than there are, so the shadow rays of each run can have the name of a different light.
    addMet(batch, *drawn.lights[run], g, beforeEmitters(batch, drawn, at, g), points.pdf, lobe, 0, Cl);
  }
}

}  // namespace tomales

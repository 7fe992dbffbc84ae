// Glossy surfaces under lights that have an extent. A highlight is a sum over samples of the light and over samples of
// the surface's own lobe. Small lights are found by their own samples, and other lights by the samples of narrow lobes.
// The power heuristic weights both (Veach and Guibas 1995, "Optimally Combining Sampling Techniques for Monte Carlo
// Rendering").
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/shade/illuminate.h"
#include "reyes/shade/light_runs.h"
#include "reyes/shade/primary.h"
#include "reyes/shade/remote_batch.h"
#include "reyes/shade/services.h"

namespace tomales {
namespace {

constexpr uint32_t kLobeStream = randomStream("lobe");

/// Returns the name of a point's samples. Displaced points are named by their place on the object, so that grids which
/// meet there agree; light probes and pixels have one name for all.
SampleName nameOf(const Batch& batch, const TmGrid* g, int i) {
  if (batch.points) return batch.points->name(i % batch.points->count());
  if (!batch.grid) return {};
  const Object& object = batch.scene.scene.objects[static_cast<size_t>(batch.grid->object)];
  return {hashCombine(object.sampleKey, __builtin_bit_cast(uint32_t, g->u[i]), __builtin_bit_cast(uint32_t, g->v[i])),
          0};
}

void lightAlong(void* host, const TmGrid* g, TmConstVec3 L, const float* pdf, int32_t sample, int32_t samples,
                TmVec3 Cl) {
  Batch& batch = batchOf(host);
  forActive(g, [&](int i) { set(Cl, i, vec3(0.0f)); });
  batch.lights.along(batch, {L, pdf, sample, samples}, Cl);
  Primary(batch, g).spread(Cl);
}

void stratified(void* host, const TmGrid* g, int32_t sample, int32_t samples, float* xi0, float* xi1) {
  const Batch& batch = batchOf(host);
  forActive(g, [&](int i) {
    const SampleName name = nameOf(batch, g, i);
    const vec2 xi = sobol2(name.sequence * static_cast<uint32_t>(samples) + static_cast<uint32_t>(sample),
                           hashCombine(name.key, kLobeStream, batch.context.seed));
    xi0[i] = xi.x;
    xi1[i] = xi.y;
  });
}

// Returns half the number of the light's samples: more would gain little with narrow lobes, and cost time with wide
// ones (docs/measured/rays.md).
int32_t lobeSamples(void* host, const TmGrid*) { return (batchOf(host).lights.mostSamples(batchOf(host)) + 1) / 2; }

/// The lobe of RISpec 15.6, (N.H)^e, with the exponent of docs/decisions/0004. Directions are drawn by H with density
/// (e + 1) / 2 pi cos^e.
struct BlinnLobe {
  vec3 N, V;
  float exponent;

  vec3 draw(const vec2& xi) const {
    const float cosine = std::pow(1 - xi.x, 1 / (exponent + 1)), sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
    vec3 tangent, bitangent;
    orthonormalBasis(N, tangent, bitangent);
    const vec3 H = sine * std::cos(2 * kPi * xi.y) * tangent + sine * std::sin(2 * kPi * xi.y) * bitangent + cosine * N;
    return 2 * dot(V, H) * H - V;
  }
  /// Returns the density over solid angle; 0 if the direction is never drawn.
  float pdf(const vec3& L) const {
    const vec3 H = normalizeOr(L + V, vec3(0.0f));
    const float cosine = dot(N, H), along = dot(V, H);
    return cosine > 0 && along > 0 ? (exponent + 1) / (2 * kPi) * std::pow(cosine, exponent) / (4 * along) : 0.0f;
  }
  /// Returns the weight of the radiance from a drawn direction: 1 / pi times the lobe over the density.
  float weight(const vec3& L) const {
    const vec3 H = normalizeOr(L + V, N);
    return dot(N, H) > 0 ? 8 * dot(V, H) / (exponent + 1) : 0.0f;
  }
  /// Returns the share of even light that the lobe sends to the viewer: 1 / pi times its integral over the hemisphere.
  /// `facing` is the cosine between N and V. The result is exact if that is 1, and within 8 per cent from 0.3 on.
  float reflectance(float facing) const {
    return 8 * facing / (exponent + 2) * (1 - std::exp2(-0.5f * (exponent + 2)));
  }
};

class Highlight {
 public:
  Highlight(Batch& batch, const TmGrid* g, TmConstVec3 N, TmConstVec3 V, const float* roughness, TmVec3 out)
      : batch_(batch),
        g_(g),
        out_(out),
        N_(batch.arena.vec3(g->count)),
        V_(batch.arena.vec3(g->count)),
        exponent_(batch.arena.floats(g->count)),
        share_(batch.arena.floats(g->count)),
        side_(batch.arena.bytes(g->count)),
        follows_(batch.points && batch.scene.services && batch.scene.services->followsLobes(batch.context)),
        drawn_(lobeSamples(&batch, g)) {
    forActive(g, [&](int i) { set(out, i, vec3(0.0f)); });
    normalizeAll(g->count, N, N_);
    normalizeAll(g->count, V, V_);
    for (int i = 0; i < g->count; ++i) exponent_[i] = batch.scene.specularSharpness / std::max(roughness[i], 1e-6f);
  }

  void addLightSamples() {
    const LightList& indirect = batch_.scene.indirect;
    const auto filters = [this](int light) {
      return batch_.scene.light(light).filters && batch_.group.lights().contains(light);
    };
    for (LightSample& sample :
         batch_.lights.samples(batch_, !follows_ || std::any_of(indirect.begin(), indirect.end(), filters))) {
      if (sample.light->nonspecular) continue;
      const bool isStored = sample.light == &batch_.scene.stored;
      if (isStored || sample.light->can(TM_LIGHT_INDIRECT)) {
        if (isStored || !follows_ || sample.light->filters) addIndirectSample(sample);
        continue;
      }
      chooseSide(view(sample.L));
      batch_.lights.shadow(batch_, sample, side_);
      setShares(g_->count, side_, sample.nonspecular, share_);
      if (sample.pdf) weighAgainstLobe(sample);
      addHighlight(g_->count, share_, view(N_), view(V_), exponent_, view(sample.L), view(sample.Cl), out_);
    }
  }

  void addLobeSamples() {
    const int n = g_->count;
    float *xi0 = batch_.arena.floats(n), *xi1 = batch_.arena.floats(n), *pdf = batch_.arena.floats(n);
    const TmVec3 L = batch_.arena.vec3(n), Cl = batch_.arena.vec3(n);
    for (int k = 0; k < drawn_; ++k) {
      stratified(&batch_, g_, k, drawn_, xi0, xi1);
      forActive(g_, [&](int i) { set(L, i, lobeAt(i).draw({xi0[i], xi1[i]})); });
      chooseSide(view(L));
      forActive(g_, [&](int i) { pdf[i] = side_[i] ? lobeAt(i).pdf(get(L, i)) : 0.0f; });
      lightAlong(&batch_, g_, view(L), pdf, k, drawn_, Cl);
      setShares(n, side_, nullptr, share_);
      addHighlight(n, share_, view(N_), view(V_), exponent_, view(L), view(Cl), out_);
    }
  }

  /// Traces paths along the lobe, if indirect light is traced by paths. Light that a filter changes comes only in its
  /// samples.
  void addPaths() {
    if (!follows_ || !batch_.context.indirect || !batch_.group.group->attributes->indirect.receive) return;
    for (const int index : batch_.group.lights().among(batch_.scene.indirect))
      if (const BoundLight& light = batch_.scene.light(index);
          !light.filters && !light.nonspecular && applies(light, batch_) &&
          (!batch_.lights.group() || light.group == *batch_.lights.group()))
        addPathsOf(light);
  }

 private:
  /// Indirect light comes from all around. Its samples have only E/pi and the mean direction. So it is modelled as
  /// radiance that changes linearly across the hemisphere and has that mean direction. The lobe reflects this radiance
  /// from the mirrored direction.
  void addIndirectSample(const LightSample& sample) {
    constexpr float kTilt = 8.0f / 3;  // A radiance of 1 + b.w has a mean direction that leans by 3 b / 8.
    constexpr float kSteepest = 2;
    chooseSide(view(sample.L));
    setShares(g_->count, side_, sample.nonspecular, share_);
    forActive(g_, [&](int i) {
      const vec3 N = get(N_, i), V = get(V_, i), L = get(sample.L, i);
      const float cosine = dot(N, L), facing = dot(N, V);
      if (!(share_[i] > 0 && cosine > 0 && facing > 0)) return;
      vec3 slope = kTilt * (L / cosine - N);
      slope *= std::min(1.0f, kSteepest / std::max(glm::length(slope), 1e-6f));
      const float seen = std::max(0.0f, 1 + dot(slope, 2 * facing * N - V));
      set(out_, i, get(out_, i) + share_[i] * cosine * seen * lobeAt(i).reflectance(facing) * get(sample.Cl, i));
    });
  }

  void addPathsOf(const BoundLight& light) {
    const int n = g_->count, count = pathCount();
    float *xi0 = batch_.arena.floats(n), *xi1 = batch_.arena.floats(n), *weight = batch_.arena.floats(n);
    const TmVec3 L = batch_.arena.vec3(n), color = batch_.arena.vec3(n);
    const vec3 scale = batch_.group.group->attributes->indirect.gain * light.sourceTint *
                       light.bound->number(TM_ROLE_SCALE, 1) * light.bound->color(TM_ROLE_TINT, vec3(1.0f));
    for (int k = 0; k < count; ++k) {
      stratified(&batch_, g_, k, count, xi0, xi1);
      forActive(g_, [&](int i) { set(L, i, lobeAt(i).draw({xi0[i], xi1[i]})); });
      chooseSide(view(L));
      forActive(g_, [&](int i) {
        weight[i] = side_[i] ? lobeAt(i).weight(get(L, i)) / static_cast<float>(count) : 0.0f;
        if (batch_.context.diffuseDepth > 0) weight[i] *= goesOn(i, weight[i]);
        side_[i] = weight[i] > 0;
      });
      batch_.scene.services->indirectAlong(*batch_.points, side_, {view(L), k, count}, light.query, batch_.context,
                                           color);
      forActive(g_, [&](int i) {
        if (side_[i]) set(out_, i, get(out_, i) + weight[i] * scale * get(color, i));
      });
    }
  }

  int pathCount() const {
    const ShadeContext& context = batch_.context;
    return context.lobes != LobeAudit::Off ? context.auditPaths
                                           : std::max(1, shareOfBranch(context.lightSamples, 1, context));
  }

  /// Where paths have branched already, most paths along lobes are ended at random, and the others get a higher weight
  /// (Russian roulette). Returns that factor, or 0.
  float goesOn(int i, float weight) const {
    constexpr float kMostBranches = 0.25f;  // a path of a dozen bounces would have thousands
    const float chance = std::min(0.5f * weight, kMostBranches);
    const SampleName name = batch_.points->name(i);
    const uint32_t draw = hashCombine(name.key ^ randomStream("goes"), name.sequence, batch_.context.seed,
                                      static_cast<uint32_t>(batch_.context.diffuseDepth));
    return chance > 0 && unitFloat(draw) < chance ? 1 / chance : 0.0f;
  }

  BlinnLobe lobeAt(int i) const { return {get(N_, i), get(V_, i), exponent_[i]}; }
  /// Only light on the side of N counts, as in illuminance(P, N, PI/2).
  void chooseSide(TmConstVec3 L) { markFacing(g_->count, g_->active, view(N_), L, side_); }
  /// Weights a light's sample against the lobe's own, which may find the light too (multiple importance sampling).
  void weighAgainstLobe(const LightSample& sample) {
    forActive(g_, [&](int i) {
      if (!side_[i] || !(sample.pdf[i] > 0)) return;
      const float other = static_cast<float>(drawn_) * lobeAt(i).pdf(get(sample.L, i)) / sample.pdf[i];
      share_[i] /= 1 + other * other;
    });
  }

  Batch& batch_;
  const TmGrid* g_;
  TmVec3 out_;
  TmVec3 N_, V_;  ///< Unit vectors.
  float *exponent_, *share_;
  uint8_t* side_;
  const bool follows_;  ///< Indirect light comes by paths along the lobe.
  const int drawn_;
};

void specular(void* host, const TmGrid* g, TmConstVec3 N, TmConstVec3 V, const float* roughness, TmVec3 out) {
  Batch& batch = batchOf(host);
  if (batch.points && !batch.context.hasHighlights(batch.points->group()))
    return forActive(g, [&](int i) { set(out, i, vec3(0.0f)); });
  const Primary primary(batch, g);
  Highlight highlight(batch, primary.grid(), N, V, roughness, out);
  highlight.addLightSamples();
  highlight.addLobeSamples();
  highlight.addPaths();
  primary.spread(out);
}

void lightDensity(void* host, const TmGrid* all, int32_t light, float* out) {
  Batch& batch = batchOf(host);
  const Primary primary(batch, all);
  const TmGrid* g = primary.grid();
  const LightSample* sample = lightNumbered(batch, light);
  const float* pdf = sample ? sample->pdf : nullptr;
  forActive(g, [&](int i) { out[i] = pdf ? pdf[i] : 0.0f; });
  primary.spread(out);
}

}  // namespace

void addLobeServices(TmServices& services) {
  services.specular = specular;
  services.lobeSamples = lobeSamples;
  services.lightDensity = lightDensity;
  services.lightAlong = lightAlong;
  services.stratified = stratified;
}

}  // namespace tomales

#include "reyes/app/frame/audit.h"

#include <fmt/format.h>

#include "reyes/app/frame/audit_pixels.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr float kAuditFloor = 0.01f;  ///< Added to the colour that errors are shares of, as in `tomales chart`.
/// Paths at each point, of which a pixel sees several, in each of the two sets: so many at first, then as many again
/// until their noise is a third of the error.
constexpr int kFewestPaths = 32, kMostPaths = 2048;
constexpr double kNoiseOfError = 1.0 / 3;
constexpr int kTimesLightSamples = 16;

/// What a kind of light brings to each pixel: in the picture, and by two independent sets of many rays.
struct FoundLight {
  std::vector<vec3> picture, sets[2];
  int rays = 0;  ///< Of each set.

  /// What is missing in the picture.
  vec3 missing(size_t p) const { return 0.5f * (sets[0][p] + sets[1][p]) - picture[p]; }
  vec3 noise(size_t p) const { return 0.5f * (sets[0][p] - sets[1][p]); }
};

class Audit {
 public:
  Audit(const Scene& scene, const ShadingSystem& shading, const ShadeContext& context, const AuditPlan& plan,
        std::vector<AuditPixel> pixels, int samplesPerPixel, const std::atomic<bool>& cancelled)
      : scene_(scene),
        shading_(shading),
        context_(context),
        plan_(plan),
        pixels_(std::move(pixels)),
        samplesPerPixel_(samplesPerPixel),
        cancelled_(cancelled) {
    context_.sketch = true;
  }

  AuditReport run() {
    AuditReport out;
    picture_ = shade(context_);
    ShadeContext direct = context_, indirect = context_;
    direct.indirect = indirect.direct = false;
    if (context_.direct) {
      out.lightSamples = kTimesLightSamples * std::max({1, context_.lightSamples, shading_.mostAreaSamples()});
      direct_.picture = shade(direct);
      direct.lightSamples = out.lightSamples;
      addSets(direct_, direct, 1);
    }
    if (plan_.indirect) {
      indirect_.picture = shade(indirect);
      for (int paths = kFewestPaths; paths <= kMostPaths / 2 && !cancelled_; paths = indirect_.rays) {
        addSets(indirect_, indirect, paths);
        const ErrorEstimate known = estimateError(errorsOf({&indirect_}));
        if (known.noise <= kNoiseOfError * known.mean) break;
      }
      out.paths = 2 * indirect_.rays;
    }
    if (context_.direct) out.direct = estimateError(errorsOf({&direct_}));
    if (plan_.indirect) out.indirect = estimateError(errorsOf({&indirect_}));
    const std::vector<AuditedError> errors = errorsOf({&direct_, &indirect_});
    out.pixels = errors.size();
    out.picture = estimateError(errors);
    return out;
  }

 private:
  std::vector<vec3> shade(const ShadeContext& context) const {
    return shadeAuditPixels(pixels_, samplesPerPixel_, scene_, shading_, context);
  }

  /// Adds `rays` to each of the two sets.
  void addSets(FoundLight& light, ShadeContext context, int rays) {
    context.auditPaths = rays;
    const float share = static_cast<float>(rays) / static_cast<float>(light.rays + rays);
    for (uint32_t set = 0; set < 2; ++set) {
      context.seed = hashCombine(plan_.seed, randomStream("sets"), 2 * static_cast<uint32_t>(light.rays) + set);
      std::vector<vec3>& mean = light.sets[set];
      mean.resize(pixels_.size(), vec3(0.0f));
      const std::vector<vec3> more = shade(context);
      for (size_t p = 0; p < mean.size(); ++p) mean[p] += share * (more[p] - mean[p]);
    }
    light.rays += rays;
  }

  /// The errors that these kinds of light make together, at the pixels that are lit.
  std::vector<AuditedError> errorsOf(std::initializer_list<const FoundLight*> kinds) const {
    std::vector<AuditedError> out;
    for (size_t p = 0; p < pixels_.size(); ++p) {
      vec3 right = picture_[p], off(0.0f), noise(0.0f);
      for (const FoundLight* light : {&direct_, &indirect_})
        if (light->rays > 0) right += light->missing(p);
      for (const FoundLight* light : kinds)
        if (light->rays > 0) off += light->missing(p), noise += light->noise(p);
      if (right == vec3(0.0f)) continue;
      AuditedError& e = out.emplace_back();
      for (int c = 0; c < 3; ++c) {
        const float unit = 3 * (std::abs(right[c]) + kAuditFloor);
        e.error += std::abs(off[c]) / unit, e.noise += std::abs(noise[c]) / unit;
      }
    }
    return out;
  }

  const Scene& scene_;
  const ShadingSystem& shading_;
  ShadeContext context_;
  const AuditPlan plan_;
  const std::vector<AuditPixel> pixels_;
  const int samplesPerPixel_;
  const std::atomic<bool>& cancelled_;
  std::vector<vec3> picture_;
  FoundLight direct_, indirect_;
};

std::string percentOf(const ErrorEstimate& e) {
  return fmt::format("{:.2g} % ({:.2g} to {:.2g})", 100 * e.mean, 100 * e.low, 100 * e.high);
}

}  // namespace

AuditReport auditFrame(const DeepFrame& layout, const TileReader& tiles, const Scene& scene,
                       const ShadingSystem& shading, const ShadeContext& context, const AuditPlan& plan,
                       const std::atomic<bool>& cancelled) {
  return Audit(scene, shading, context, plan, chooseAuditPixels(layout, tiles, plan.pixels, plan.seed, cancelled),
               layout.samplesPerPixel, cancelled)
      .run();
}

void recordAudit(const AuditReport& r, Stats& stats) {
  const auto add = [&](const char* light, const ErrorEstimate& e) {
    stats.addAudit(light, {e.mean, e.low, e.high, e.noise, e.p99});
  };
  stats.audit.pixels = static_cast<int64_t>(r.pixels), stats.audit.paths = r.paths;
  add("picture", r.picture);
  if (r.indirect) add("indirect", *r.indirect);
  if (r.direct) add("direct", *r.direct);
}

std::string sentenceOf(const AuditReport& r) {
  if (r.pixels == 0) return "nothing to audit: no pixel sees a lit surface";
  std::string parts;
  if (r.indirect)
    parts += fmt::format("; indirect light {}, by {} paths at each point", percentOf(*r.indirect), r.paths);
  if (r.direct) parts += fmt::format("; direct light {}", percentOf(*r.direct));
  if (!r.indirect) parts += "; there is no indirect light to audit";
  return fmt::format(
      "mean error {}, 90 % confidence, {} pixels{}; 99 % of them err by less than {:.2g} %, "
      "which is an estimate",
      percentOf(r.picture), r.pixels, parts, 100 * r.picture.p99);
}

}  // namespace tomales

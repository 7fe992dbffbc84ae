#include "reyes/app/frame/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reyes/app/frame/audit_pixels.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr float kAuditFloor = 0.01f;  ///< Added to the divisor of relative errors, as in `tomales chart`.
/// Numbers of paths at each point in each of the two sets; a pixel sees several points. The number is kFewestPaths at
/// first, and grows until the noise is small beside the error.
constexpr int kFewestPaths = 32, kMostPaths = 2048;
constexpr double kNoiseOfError = 0.4;
constexpr int kMostGrowth = 4;  ///< No more than so many times the paths are added at once: a few tell little.
constexpr int kTimesLightSamples = 8;
constexpr size_t kPixelsPerBlock = 6;
constexpr float kMeanOfNormal = 0.7979f;  ///< Mean absolute value of draws from the normal distribution.

std::string percentOf(const ErrorEstimate& e) {
  if (!e.tells()) return fmt::format("at most {:.2g} %, as smaller ones are hidden by the audit's noise", 100 * e.high);
  return fmt::format("{:.2g} % ({:.2g} to {:.2g})", 100 * e.mean, 100 * e.low, 100 * e.high);
}

}  // namespace

Audit::Audit(const DeepFrame& layout, const TileReader& tiles, const Scene& scene, const ShadingSystem& shading,
             const AuditSettings& settings, StopToken stop)
    : scene_(scene),
      shading_(shading),
      settings_(settings),
      pixels_(chooseAuditPixels(layout, tiles, settings.pixels, settings.seed, stop)),
      samplesPerPixel_(layout.samplesPerPixel),
      stop_(stop),
      smudges_(layout, tiles, scene, shading,
               {std::max(settings.pixels / kPixelsPerBlock, SmudgeEstimate::kFewestBlocks), settings.smudgeSizes,
                settings.seed, std::max({1, settings.lightSamples, shading.mostAreaSamples()}), settings.leastSmudges},
               stop) {}

AuditReport Audit::of(const ShadeContext& context) {
  AuditReport out;
  picture_ = shade(context);
  const bool direct = context.direct && settings_.direct;
  if (direct) out.lightSamples = findDirect(context);
  if (settings_.indirect) out.paths = 2 * findIndirect(context);
  if (direct) out.direct = estimateError(errorsOf({&direct_}));
  if (settings_.indirect) out.indirect = estimateError(errorsOf({&indirect_}));
  if (!glossy_.empty()) out.highlights = estimateError(errorsOf({&highlights_}));
  const std::vector<AuditedError> errors = errorsOf({&direct_, &indirect_, &highlights_});
  out.pixels = errors.size();
  out.picture = estimateError(errors);
  out.pixelSamples = pixelSampleError();
  out.smudges = smudges_.of(context);
  return out;
}

std::vector<SampledColor> Audit::shade(ShadeContext context) const {
  context.purpose = Purpose::Sketch;
  return shadeAuditPixels(pixels_, samplesPerPixel_, scene_, shading_, context);
}

double Audit::pointCount() const {
  double out = 0;
  for (const AuditPixel& p : pixels_) out += pointsOf(p.tile);
  return out;
}

std::vector<vec3> Audit::colors(const ShadeContext& context) const {
  std::vector<vec3> out;
  for (const SampledColor& c : shade(context)) out.push_back(c.mean);
  return out;
}

double Audit::pixelSampleError() const {
  double sum = 0, count = 0;
  for (const SampledColor& c : picture_) {
    if (c.mean == vec3(0.0f)) continue;
    for (int k = 0; k < 3; ++k) sum += double{kMeanOfNormal * c.error[k] / (std::abs(c.mean[k]) + kAuditFloor)} / 3;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// Returns the number of light samples at each point.
int Audit::findDirect(ShadeContext context) {
  context.indirect = false;
  direct_.picture = colors(context);
  context.lightSamples =
      kTimesLightSamples * std::max({1, context.lightSamples, settings_.lightSamples, shading_.mostAreaSamples()});
  if (direct_.rays == 0) addSets(direct_, context, 1);
  return context.lightSamples;
}

/// Returns the number of paths at each point in each set.
int Audit::findIndirect(ShadeContext context) {
  context.direct = false;
  indirect_.picture = colors(context);
  if (settings_.lobes && indirect_.rays == 0) findGlossy(context);
  for (int missing = kFewestPaths - indirect_.rays; missing > 0 && !stop_.requested(); missing = missingPaths())
    addSets(indirect_, context, missing);
  return indirect_.rays;
}

/// Finds the pixels whose colour changes if highlights of indirect light reflect an even light.
void Audit::findGlossy(ShadeContext context) {
  context.auditPaths = 1;
  context.seed = hashCombine(settings_.seed, randomStream("glos"));
  const std::vector<vec3> without = colors(context);
  context.lobes = LobeAudit::Even;
  const std::vector<vec3> with = colors(context);
  for (size_t p = 0; p < pixels_.size(); ++p) {
    if (with[p] == without[p]) continue;
    glossy_.push_back(p);
    glossyPixels_.push_back(pixels_[p]);
  }
  highlights_.picture.assign(pixels_.size(), vec3(0.0f));
}

/// Returns how the colour of each pixel changes where the same paths also follow lobes.
std::vector<vec3> Audit::highlightsBeside(const std::vector<vec3>& without, ShadeContext context) const {
  context.lobes = LobeAudit::Paths;
  const std::vector<SampledColor> with = shadeAuditPixels(glossyPixels_, samplesPerPixel_, scene_, shading_, context);
  std::vector<vec3> out(pixels_.size(), vec3(0.0f));
  for (size_t i = 0; i < glossy_.size(); ++i) out[glossy_[i]] = with[i].mean - without[glossy_[i]];
  return out;
}

/// Returns how many more paths each set needs. The square of noise falls with their number.
int Audit::missingPaths() const {
  const ErrorEstimate known = estimateError(errorsOf({&indirect_, &highlights_}));
  const double allowed = kNoiseOfError * std::max(known.mean, settings_.leastError);
  if (!(known.noise > allowed)) return 0;  // also if it is no number
  const double growth = allowed > 0 ? known.noise * known.noise / (allowed * allowed) : kMostGrowth;
  const double rays = std::min(growth, double{kMostGrowth}) * indirect_.rays;
  return std::min(static_cast<int>(std::ceil(rays)), kMostPaths) - indirect_.rays;
}

/// Adds `rays` to each of the two sets, and the highlights that these rays find.
void Audit::addSets(FoundLight& light, ShadeContext context, int rays) {
  context.auditPaths = rays;
  const float share = static_cast<float>(rays) / static_cast<float>(light.rays + rays);
  const auto add = [&](const std::vector<vec3>& more, std::vector<vec3>& mean) {
    mean.resize(pixels_.size(), vec3(0.0f));
    for (size_t p = 0; p < mean.size(); ++p) mean[p] += share * (more[p] - mean[p]);
  };
  const bool hasHighlights = &light == &indirect_ && !glossy_.empty();
  for (uint32_t set = 0; set < 2; ++set) {
    context.seed = hashCombine(settings_.seed, randomStream("sets"), 2 * static_cast<uint32_t>(light.rays) + set);
    const std::vector<vec3> found = colors(context);
    add(found, light.sets[set]);
    if (hasHighlights) add(highlightsBeside(found, context), highlights_.sets[set]);
  }
  light.rays += rays;
  if (hasHighlights) highlights_.rays = light.rays;
}

/// Returns the errors that these kinds of light make together, at the pixels that are lit or seem to be.
std::vector<AuditedError> Audit::errorsOf(std::initializer_list<const FoundLight*> kinds) const {
  std::vector<AuditedError> out;
  for (size_t p = 0; p < pixels_.size(); ++p) {
    vec3 right = picture_[p].mean, off(0.0f), noise(0.0f);
    for (const FoundLight* light : {&direct_, &indirect_, &highlights_})
      if (light->rays > 0) right += light->missing(p);
    for (const FoundLight* light : kinds)
      if (light->rays > 0) {
        off += light->missing(p);
        noise += light->noise(p);
      }
    if (right == vec3(0.0f) && picture_[p].mean == vec3(0.0f)) continue;
    AuditedError& e = out.emplace_back();
    for (int c = 0; c < 3; ++c) {
      const float unit = 3 * (std::abs(right[c]) + kAuditFloor);
      e.error += std::abs(off[c]) / unit;
      e.noise += std::abs(noise[c]) / unit;
    }
  }
  return out;
}

void recordAudit(const AuditReport& r, Stats& stats) {
  const auto add = [&](const char* light, const ErrorEstimate& e) {
    stats.addAudit(light, {e.mean, e.low, e.high, e.noise, e.p99});
  };
  stats.audit.pixels = static_cast<int64_t>(r.pixels);
  stats.audit.paths = r.paths;
  if (r.pixelSamples > 0) stats.addAudit("pixel_samples", {r.pixelSamples, 0, r.pixelSamples, 0, 0});
  for (const SmudgeEstimate& s : r.smudges)
    stats.addAudit(fmt::format("smudges_{}", s.size), {s.deviation, s.low, s.high, s.noise, 0});
  add("picture", r.picture);
  if (r.indirect) add("indirect", *r.indirect);
  if (r.highlights) add("highlights", *r.highlights);
  if (r.direct) add("direct", *r.direct);
}

std::string sentenceOf(const AuditReport& r) {
  if (r.pixels == 0) return "nothing to audit: no pixel sees a lit surface";
  std::string parts;
  if (r.indirect)
    parts += fmt::format("; indirect light {}, by {} paths at each point", percentOf(*r.indirect), r.paths);
  if (r.highlights) parts += fmt::format("; its highlights {}", percentOf(*r.highlights));
  if (r.direct) parts += fmt::format("; direct light {}", percentOf(*r.direct));
  if (r.pixelSamples > 0) parts += fmt::format("; the pixels' samples add up to about {:.2g} %", 100 * r.pixelSamples);
  for (const SmudgeEstimate& s : r.smudges)
    parts += &s == r.finestSmudges() ? fmt::format("; smudges of {:.2g} % ({:.2g} to {:.2g}) over blocks of {} pixels",
                                                   100 * s.deviation, 100 * s.low, 100 * s.high, s.size)
                                     : fmt::format(", {:.2g} % over {}", 100 * s.deviation, s.size);
  if (r.smudges.empty()) parts += "; no region is smooth enough to show smudges";
  if (!r.indirect) parts += "; there is no indirect light to audit";
  return fmt::format(
      "mean error {}, 90 % confidence, {} pixels{}; 99 % of them err by less than {:.2g} %, "
      "which is an estimate",
      percentOf(r.picture), r.pixels, parts, 100 * r.picture.p99);
}

}  // namespace tomales

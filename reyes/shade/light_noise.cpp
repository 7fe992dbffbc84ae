#include "reyes/shade/light_noise.h"

#include <fmt/format.h>

#include "reyes/shade/batch.h"

namespace tomales {
namespace {

constexpr float kUncertain = 0.2f;
constexpr double kShareOfPoints = 0.5;
constexpr int64_t kFewPoints = 100;  ///< Fewer points than this say nothing about a picture.

/// The luminance that each half of a light's samples brings to matte points of reflectance 1. The halves are the
/// samples before and after the middle. Each is well distributed, because they are the beginning and the continuation
/// of a Sobol sequence.
struct Halves {
  const BoundLight* light;
  bool chance;  ///< True if its samples are drawn; those of an indirect light are its colours.
  float *first, *second;
};

bool isDrawn(const BoundLight& light) {
  return light.can(TM_LIGHT_AREA) || light.can(TM_LIGHT_SKY) || light.can(TM_LIGHT_SAMPLED);
}

void addSample(const Batch& batch, const LightSample& sample, float* sum) {
  for (int i = 0; i < batch.points->count(); ++i) {
    const float cosine = dot(batch.points->facingNormal(i), get(sample.L, i));
    const bool counts = cosine > 0 && !(sample.pending && sample.pending[i]);  // a pending sample was not asked for
    if (counts) sum[i] += cosine * luminance(get(sample.Cl, i));
  }
}

/// Sums up each light's samples, which follow each other.
std::vector<Halves> halvesOf(Batch& batch, const std::vector<LightSample>& samples) {
  std::vector<Halves> out;
  const int n = batch.points->count();
  for (size_t begin = 0, end; begin < samples.size(); begin = end) {
    for (end = begin + 1; end < samples.size() && samples[end].light == samples[begin].light;) ++end;
    const BoundLight& which = *samples[begin].light;
    const Halves& light = out.emplace_back(Halves{&which, isDrawn(which) && end - begin > 1 && !samples[begin].drawn,
                                                  batch.arena.floats(n), batch.arena.floats(n)});
    std::fill_n(light.first, n, 0.0f);
    std::fill_n(light.second, n, 0.0f);
    for (size_t s = begin; s < end; ++s)
      addSample(batch, samples[s], 2 * (s - begin) < end - begin ? light.first : light.second);
  }
  return out;
}

}  // namespace

void LightNoise::add(Batch& batch) {
  const ShadeContext& context = batch.context;
  if (context.kind != RayKind::Camera || context.purpose != Purpose::Picture ||
      context.illumination != Illumination::Lights)
    return;
  const std::vector<LightSample>& samples = batch.lights.evaluated();
  if (std::none_of(samples.begin(), samples.end(),
                   [](const LightSample& s) { return isDrawn(*s.light) && s.rays.samples > 1 && !s.drawn; }))
    return;
  const std::vector<Halves> lights = halvesOf(batch, samples);
  // If several points lie in a pixel, their noise averages.
  const float most = kUncertain / std::sqrt(std::min(batch.group.group->attributes->shadingRate, 1.0f));
  std::vector<int64_t> uncertain(lights.size());
  int64_t lit = 0;
  for (int i = 0; i < batch.points->count(); ++i) {
    float sum = 0;
    for (const Halves& l : lights) sum += l.first[i] + l.second[i];
    lit += sum > 0;
    for (size_t l = 0; l < lights.size(); ++l)
      uncertain[l] += lights[l].chance && std::abs(lights[l].first[i] - lights[l].second[i]) > most * sum;
  }
  lit_ += lit;
  for (size_t l = 0; l < lights.size(); ++l)
    if (lights[l].chance) uncertain_[static_cast<size_t>(lights[l].light->index)] += uncertain[l];
}

void LightNoise::warn(const BoundScene& scene) const {
  const auto worst = std::max_element(uncertain_.begin(), uncertain_.end());
  const double lit = static_cast<double>(lit_.load());
  if (lit_ < kFewPoints || worst == uncertain_.end() || static_cast<double>(worst->load()) <= kShareOfPoints * lit)
    return;
  const BoundLight& light = *scene.lights[static_cast<size_t>(worst - uncertain_.begin())];
  scene.log.report(
      Severity::Warning, "light-noise", light.bound->where,
      fmt::format("{}: its samples leave {:.0f} % of the points that are seen uncertain by more than {:.0f} % of their "
                  "light: most of the light is "
                  "hidden, or small (\"samples\" of the light, --light-samples; \"portals\" of a sky behind windows)",
                  light.bound->user, 100 * static_cast<double>(worst->load()) / lit, 100 * kUncertain));
}

}  // namespace tomales

#include "reyes/shade/light_use.h"

#include <fmt/format.h>

#include "reyes/camera_bound.h"
#include "reyes/output.h"
#include "reyes/shade/batch.h"

namespace tomales {
namespace {

constexpr size_t kMostNamed = 3;       ///< One message names no more surfaces.
constexpr int64_t kFewLitPoints = 10;  ///< Fewer counted points say nothing about a picture.
constexpr double kShareOfLitPoints = 0.5;
/// One point in this many is counted, which gives a share of the picture as well as all points do.
constexpr int kCounted = 16;
constexpr int kGlare_stops = 4;  ///< No film of any time shows white paper at sixteen times its white.

bool isDirect(const BoundLight& light) { return !light.can(TM_LIGHT_INDIRECT); }

bool emits(const BoundScene& scene) {
  for (size_t g = 0; g < scene.groups.size(); ++g)
    if (scene.groups[g].surface->can(TM_EMITS)) return true;
  return false;
}

std::string named(const std::set<std::string>& names) {
  std::string out;
  size_t n = 0;
  for (const std::string& name : names)
    if (n++ < kMostNamed) out += (out.empty() ? "" : ", ") + name;
  return n > kMostNamed ? fmt::format("{} and {} more", out, n - kMostNamed) : out;
}

/// Returns the name of the smallest object around a point. Empty if there is none, or shapes are not at hand.
std::string around(const Scene& scene, const vec3& place) {
  const Object* smallest = nullptr;
  float least = kInfinity;
  for (const Object& o : scene.objects) {
    const Bound3 box = cameraBound(o);
    const bool inside =
        !box.empty() && glm::all(glm::greaterThan(place, box.lo)) && glm::all(glm::lessThan(place, box.hi));
    const vec3 size = box.hi - box.lo;
    const float volume = size.x * size.y * size.z;
    if (inside && volume < least) {
      smallest = &o;
      least = volume;
    }
  }
  return smallest ? objectName(*smallest) : "";
}

}  // namespace

void LightUse::add(const Batch& batch) {
  const ShadeContext& context = batch.context;
  if (context.kind != RayKind::Camera || context.purpose != Purpose::Picture ||
      context.illumination != Illumination::Lights || !batch.lights.asked())
    return;
  const LightList& lights = batch.group.lights();
  if (std::none_of(lights.begin(), lights.end(), [&](int light) { return isDirect(batch.scene.light(light)); })) {
    const std::lock_guard lock(mutex_);
    unlit_.insert(&batch.group);
  }
  for (const int light : batch.lights.alone(batch)) {
    Use& use = uses_[static_cast<size_t>(light)];
    use.asked.store(true, std::memory_order_relaxed);
    if (batch.scene.light(light).can(TM_LIGHT_AMBIENT)) use.comes.store(true, std::memory_order_relaxed);
  }
  for (const LightSample& sample : batch.lights.evaluated()) {
    if (sample.drawn) continue;  // few of many lights say nothing of each
    Use& use = uses_[static_cast<size_t>(sample.light->index)];
    if (!use.comes.load(std::memory_order_relaxed)) follow(batch, sample, use);
  }
  countStops(batch);
}

// Notes the points of a batch to which a lamp sends light. A traced shadow ray means that there was light, and that a
// surface asked for it.
void LightUse::follow(const Batch& batch, const LightSample& sample, Use& use) {
  for (int i = 0; i < batch.points->count(); ++i) {
    const bool sent = get(sample.Cl, i) != vec3(0.0f), traced = sample.pending && !sample.pending[i];
    if (!sent && !traced) continue;
    const bool faces =
        sample.pending ? traced : sample.fromBehind || dot(batch.points->facingNormal(i), get(sample.L, i)) > 0;
    // The places of an area light differ, and which of them is seen first depends on threads.
    if (!use.bright.exchange(true) && !sample.rays.solar && !sample.light->can(TM_LIGHT_AREA)) {
      const std::lock_guard lock(mutex_);
      places_[static_cast<size_t>(sample.light->index)] = batch.points->position(i) + get(sample.far, i);
    }
    if (faces) use.faces.store(true, std::memory_order_relaxed);
    if (faces && sent) return use.comes.store(true, std::memory_order_relaxed);
  }
}

/// Counts points by how bright white paper would be there, by diffuse(), in the light of each lamp.
void LightUse::countStops(const Batch& batch) {
  const std::vector<LightSample>& samples = batch.lights.evaluated();
  const int n = batch.points->count(), counted = (n + kCounted - 1) / kCounted;
  static thread_local std::vector<float> sum;
  for (size_t begin = 0, end; begin < samples.size(); begin = end) {
    const BoundLight& light = *samples[begin].light;
    if (samples[begin].drawn) {
      end = begin + 1;
      continue;
    }
    sum.assign(static_cast<size_t>(counted), 0.0f);
    for (end = begin; end < samples.size() && samples[end].light == &light; ++end)
      for (int i = 0; i < n; i += kCounted) {
        const float cosine = dot(batch.points->facingNormal(i), get(samples[end].L, i));
        const bool counts = cosine > 0 && !(samples[end].pending && samples[end].pending[i]);
        if (counts) sum[static_cast<size_t>(i / kCounted)] += cosine * luminance(get(samples[end].Cl, i));
      }
    for (const float brightness : sum)
      if (brightness >= 1)
        ++uses_[static_cast<size_t>(light.index)]
              .stops[static_cast<size_t>(std::min(std::ilogb(brightness), kStops - 1))];
  }
  points_ += counted;
}

void LightUse::warn(const BoundScene& scene) const {
  if (!shades(scene.scene.options)) return;  // a map for later frames needs no light
  warnOfDarkness(scene);
  const bool whole = scene.scene.options.cropWindow == Options().cropWindow;
  const bool indirect =
      std::any_of(scene.lights.begin(), scene.lights.end(), [](const auto& l) { return l && !isDirect(*l); });
  if (whole && !indirect) warnOfUseless(scene);  // what a lamp sends elsewhere comes back from there
  warnOfGlare(scene);
}

void LightUse::warnOfDarkness(const BoundScene& scene) const {
  if (unlit_.empty()) return;
  std::set<std::string> names;
  for (const BoundGroup* group : unlit_) names.insert(group->object);
  const auto& lights = scene.lights;
  const bool none = std::none_of(lights.begin(), lights.end(), [](const auto& l) { return l && isDirect(*l); });
  const bool indirect = std::any_of(lights.begin(), lights.end(), [](const auto& l) { return l && !isDirect(*l); });
  if (none && indirect && emits(scene)) return;  // what glows lights the scene by way of the indirect light
  if (none)
    scene.log.report(Severity::Warning, "light-none", scene.scene.where,
                     fmt::format("there is no light in this world, and what asks for light is dark: {}; LightSource "
                                 "\"distantlight\" 1 before the objects would light them",
                                 named(names)));
  else
    scene.log.report(Severity::Note, "light-off", scene.scene.where,
                     fmt::format("no light is switched on for {}, which {} for light: a light shines on what follows "
                                 "it up to the end of its block, and Illuminate switches it",
                                 named(names), names.size() == 1 ? "asks" : "ask"));
}

std::string LightUse::whyUseless(const BoundScene& scene, const Use& use, size_t index) const {
  if (!use.bright) return "its shader sends no light to where surfaces ask for it (intensity, colour, cone, falloff)";
  std::string out = use.faces ? "all that faces it lies in its shadow" : "all that it shines on faces away from it";
  const auto place = places_.find(index);
  const std::string object = place == places_.end() ? "" : around(scene.scene, place->second);
  return object.empty() ? out : out + fmt::format("; it stands within the bounds of {}", object);
}

void LightUse::warnOfUseless(const BoundScene& scene) const {
  for (size_t k = 0; k < uses_.size(); ++k) {
    const Use& use = uses_[k];
    if (!use.asked || use.comes || !scene.lights[k] || !isDirect(*scene.lights[k])) continue;
    const BoundShader& light = *scene.lights[k]->bound;
    scene.log.report(Severity::Note, "light-useless", light.where,
                     fmt::format("{} reaches nothing that the camera sees: {}", light.user, whyUseless(scene, use, k)));
  }
}

void LightUse::warnOfGlare(const BoundScene& scene) const {
  if (points_ < kFewLitPoints) return;
  const int gain_stops = static_cast<int>(std::floor(std::log2(std::max(scene.scene.options.exposureGain, 1e-6f))));
  for (size_t k = 0; k < uses_.size(); ++k) {
    const double half = kShareOfLitPoints * static_cast<double>(points_);
    int64_t brighter = 0;
    int stop = kStops;
    while (stop > 0 && static_cast<double>(brighter) <= half) brighter += uses_[k].stops[static_cast<size_t>(--stop)];
    if (static_cast<double>(brighter) <= half || stop + gain_stops < kGlare_stops) continue;
    const BoundShader& light = *scene.lights[k]->bound;
    scene.log.report(Severity::Warning, "light-glare", light.where,
                     fmt::format("{} alone makes white paper at least {:.0f} times as bright as white in half of what "
                                 "is seen: is its intensity meant for another falloff with distance? (--arealight, and "
                                 "\"lights\" in docs/rib_support.md)",
                                 light.user, std::exp2(stop + gain_stops)));
  }
}

}  // namespace tomales

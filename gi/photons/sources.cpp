#include "gi/photons/sources.h"

#include "gi/photons/emissive_photons.h"
#include "gi/photons/light_photons.h"
#include "reyes/base/parallel.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

std::vector<std::unique_ptr<const PhotonSource>> sourcesOf(const RayScene& rays, const ShadingSystem& shading,
                                                           const PhotonSettings& settings, Log& log) {
  const Scene& scene = rays.scene();
  const PhotonTarget target(scene);
  std::vector<std::unique_ptr<const PhotonSource>> sources;
  const auto add = [&](std::unique_ptr<const PhotonSource> source) {
    if (source && source->power() > 0) sources.push_back(std::move(source));
  };
  for (const auto& light : scene.lights) {
    const bool isOn = std::any_of(scene.groups.begin(), scene.groups.end(),
                                  [&](const ShadeGroup& g) { return isOnFor(g, light->index); });
    if (!isOn) continue;
    if (shading.light(light->index).kind() == LightKind::Ambient) {
      log.report(Severity::Warning, "photons-ambient", light->shader.where,
                 "light \"" + light->handle + "\" comes from nowhere: it emits no photons");
      continue;
    }
    add(photonsOf(light->index, shading, rays, target));
  }
  // A glowing surface is the first surface of its photons, and a diffuse one.
  const bool glows = settings.maxDepth > 1 && settings.mostBounces > 0 && !settings.specularFirstOnly;
  if (!glows && !sources.empty()) return sources;
  auto glow = std::make_unique<EmissivePhotons>(rays, shading, settings.seed, log);
  if (sources.empty() && glow->power() <= 0)
    log.report(Severity::Warning, "photons-no-light", scene.where,
               "nothing in the scene emits photons, neither lights nor surfaces: indirect light is black");
  if (glows) add(std::move(glow));
  return sources;
}

PhotonSettings withDepth(PhotonSettings settings) {
  if (settings.maxDepth <= 0) settings.maxDepth = kEnoughBounces;
  return settings;
}

}  // namespace

PhotonSources::PhotonSources(const RayScene& rays, const ShadingSystem& shading, const PhotonSettings& settings,
                             Log& log)
    : settings_(withDepth(settings)),
      sources_(sourcesOf(rays, shading, settings_, log)),
      tracer_(rays.scene(), rays, shading, settings_, log) {
  for (const auto& s : sources_) power_ += s->power();
}

std::vector<PhotonSources::Sent> PhotonSources::shared(int64_t emit) const {
  std::vector<Sent> out;
  for (const auto& s : sources_) {
    const double share = std::round(static_cast<double>(emit) * s->power() / power_);
    out.push_back({s.get(), static_cast<size_t>(std::max(1.0, share))});
  }
  return out;
}

std::vector<PhotonSources::PhotonRange> PhotonSources::rangesOf(WorkPart part) const {
  const auto tasksOf = [](const Sent& s) { return (s.count + kPhotonsPerTask - 1) / kPhotonsPerTask; };
  const std::vector<Sent> all = shared(settings_.emit);
  size_t tasks = 0, before = 0;
  for (const Sent& s : all) tasks += tasksOf(s);
  const auto borderOf = [&](int index) { return tasks * static_cast<size_t>(index) / static_cast<size_t>(part.count); };
  const size_t begin = borderOf(part.index), end = borderOf(part.index + 1);
  std::vector<PhotonRange> out;
  for (const Sent& s : all) {
    const auto photonOf = [&](size_t task) {
      return std::min(s.count, (std::clamp(task, before, before + tasksOf(s)) - before) * kPhotonsPerTask);
    };
    if (photonOf(begin) < photonOf(end)) out.push_back({s, photonOf(begin), photonOf(end)});
    before += tasksOf(s);
  }
  return out;
}

void PhotonSources::trace(const Sent& from, uint32_t seed, size_t first, size_t end,
                          const std::function<void(size_t, std::vector<StoredPhoton>&&)>& taken) const {
  const float share = 1 / static_cast<float>(from.count);
  const size_t tasks = (end - first + kPhotonsPerTask - 1) / kPhotonsPerTask;
  parallelFor(tasks, 1, [&](size_t begin, size_t last) {
    for (size_t task = begin; task < last; ++task) {
      const size_t at = first + task * kPhotonsPerTask;
      std::vector<StoredPhoton> photons;
      const auto turn = static_cast<uint32_t>(uint64_t{at} >> 32);  // photons have numbers of 32 bits
      const uint32_t own = turn == 0 ? seed : hashCombine(seed, turn);
      tracer_.trace(*from.source, own, static_cast<uint32_t>(at), std::min(kPhotonsPerTask, end - at), share, photons);
      taken(task, std::move(photons));
    }
  });
}

int64_t PhotonSources::pass(uint32_t seed, int64_t emit,
                            const std::function<void(std::span<const StoredPhoton>)>& count) const {
  int64_t sum = 0;
  for (const Sent& s : shared(emit)) {
    trace(s, seed, 0, s.count, [&](size_t, std::vector<StoredPhoton>&& photons) { count(photons); });
    sum += static_cast<int64_t>(s.count);
  }
  return sum;
}

}  // namespace tomales

#include "gi/photons.h"

#include <fmt/format.h>

#include <numeric>

#include "gi/photons/glow.h"
#include "gi/photons/tracer.h"
#include "reyes/base/parallel.h"

namespace tomales {
namespace {

constexpr size_t kPhotonsPerTask = 2048,
                 kTasksPerThread = 8;  ///< A task's photons are stored while they are in the processor's cache.

std::vector<std::unique_ptr<const PhotonSource>> sourcesOf(const RayScene& rays, const ShadingSystem& shading,
                                                           uint32_t seed, Log& log) {
  const Scene& scene = rays.scene();
  const PhotonTarget target(scene);
  std::vector<std::unique_ptr<const PhotonSource>> sources;
  const auto add = [&](std::unique_ptr<const PhotonSource> source) {
    if (source->power() > 0) sources.push_back(std::move(source));
  };
  for (const auto& light : scene.lights) {
    const LightKind kind = shading.lightKind(light->index);
    const bool isOn = std::any_of(scene.groups.begin(), scene.groups.end(),
                                  [&](const ShadeGroup& g) { return isOnFor(g, light->index); });
    if (!isOn || kind == LightKind::None || kind == LightKind::Indirect) continue;
    if (kind == LightKind::Ambient) {
      log.report(Severity::Warning, "photons-ambient", light->shader.where,
                 "light \"" + light->handle + "\" comes from nowhere: it emits no photons");
      continue;
    }
    add(std::make_unique<LightPhotons>(light->index, shading, rays, target));
  }
  add(std::make_unique<GlowPhotons>(rays, shading, seed, log));
  return sources;
}

/// The powers of all arrivals, by their number on the path.
class Series {
 public:
  explicit Series(int length) : power_(static_cast<size_t>(length), 0.0) {}
  void add(std::span<const StoredPhoton> photons) {
    for (const StoredPhoton& p : photons) power_[static_cast<size_t>(p.depth)] += double{luminance(p.power)};
  }

  /// What each arrival is of the one before, at the end. `emitted`: all power, in place of first arrivals.
  double ratio(double emitted) const {
    const size_t n = power_.size();
    if (n < 2 || !(power_[n - 1] > 0)) return 0;
    return std::min(power_[n - 1] / (n == 2 ? emitted : power_[n - 2]), kLargestRatio);
  }
  /// The share of reflected light that would arrive later if it went on as a geometric series.
  double left(double emitted) const {
    const double r = ratio(emitted), rest = power_.back() * r / (1 - r),
                 reflected = std::accumulate(power_.begin() + 1, power_.end(), 0.0);
    return r > 0 ? rest / (reflected + rest) : 0;
  }

 private:
  static constexpr double kLargestRatio = 0.999;
  std::vector<double> power_;
};

/// Says how much is left after the last arrival, and how many more would leave a hundredth.
void tellLeft(double left, double ratio, int depth, bool isAsked, const SourceLoc& where, Log& log) {
  constexpr double kLittle = 0.01;
  const Severity severity = left < kLittle ? Severity::Info : isAsked ? Severity::Note : Severity::Warning;
  std::string message = fmt::format(
      "after {} bounces {:.1f} % of the light that surfaces send each other is left, "
      "and is missing",
      depth, 100 * left);
  if (left >= kLittle)
    message += fmt::format(
        ": each bounce has {:.0f} % of the one before, and --bounces {} or \"bounces\" of the "
        "indirect light would leave 1 %",
        100 * ratio, depth + static_cast<int>(std::ceil(std::log(kLittle / left) / std::log(ratio))));
  log.report(severity, "photons-bounces", where, message);
}

}  // namespace

std::optional<PhotonModel> photonModel(const std::string& name) {
  static constexpr std::pair<std::string_view, PhotonModel> kModels[] = {
      {"matte", PhotonModel::Matte},   {"translucent", PhotonModel::Translucent},
      {"chrome", PhotonModel::Chrome}, {"glass", PhotonModel::Glass},
      {"water", PhotonModel::Water},   {"transparent", PhotonModel::Transparent}};
  for (const auto& [known, model] : kModels)
    if (known == name) return model;
  return std::nullopt;
}

PhotonFigures tracePhotons(const Scene& scene, const RayScene& rays, const ShadingSystem& shading,
                           const PhotonSettings& given, const std::function<void(std::span<const StoredPhoton>)>& store,
                           const std::function<void(float)>& progress, Stats& stats, Log& log) {
  PhotonSettings settings = given;
  if (given.maxDepth <= 0) settings.maxDepth = kEnoughBounces;
  const auto sources = sourcesOf(rays, shading, settings.seed, log);
  const double total =
      std::accumulate(sources.begin(), sources.end(), 0.0, [](double sum, const auto& s) { return sum + s->power(); });
  if (sources.empty())
    log.report(Severity::Warning, "photons-no-light", scene.where,
               "nothing in the scene emits photons, neither lights nor surfaces: indirect light is black");
  const PhotonTracer tracer(scene, rays, shading, settings, log);
  PhotonFigures figures;
  Series series(settings.maxDepth);
  std::vector<std::vector<StoredPhoton>> stored;
  const size_t photonsPerWave = kPhotonsPerTask * kTasksPerThread * static_cast<size_t>(threadCount());
  for (const auto& source : sources) {
    // What glows is the first surface of its photons.
    if (source->light() < 0 && settings.maxDepth < 2) continue;
    const auto count =
        static_cast<size_t>(std::max(1.0, std::round(static_cast<double>(settings.emit) * source->power() / total)));
    const float share = 1 / static_cast<float>(count);
    for (size_t wave = 0; wave < count; wave += photonsPerWave) {
      const size_t end = std::min(count, wave + photonsPerWave);
      stored.resize((end - wave + kPhotonsPerTask - 1) / kPhotonsPerTask);
      parallelFor(stored.size(), 1, [&](size_t begin, size_t last) {
        for (size_t task = begin; task < last; ++task) {
          const size_t first = wave + task * kPhotonsPerTask;
          stored[task].clear();
          tracer.trace(*source, static_cast<uint32_t>(first), std::min(kPhotonsPerTask, end - first), share,
                       stored[task]);
        }
      });
      for (const auto& photons : stored) {
        store(photons);
        series.add(photons);
        figures.stored += static_cast<int64_t>(photons.size());
      }
      if (progress)
        progress(static_cast<float>(figures.emitted + static_cast<int64_t>(end)) / static_cast<float>(settings.emit));
    }
    figures.emitted += static_cast<int64_t>(count);
  }
  stats.rays.photon += figures.emitted;
  figures.left = series.left(total);
  if (!sources.empty() && settings.maxDepth > 1)
    tellLeft(figures.left, series.ratio(total), settings.maxDepth, given.maxDepth > 0, scene.where, log);
  return figures;
}

}  // namespace tomales

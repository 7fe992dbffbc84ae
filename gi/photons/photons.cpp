#include "gi/photons.h"

#include <numeric>

#include "gi/gather/bounces_left.h"
#include "gi/photons/sources.h"
#include "reyes/base/parallel.h"

namespace tomales {
namespace {

constexpr size_t kTasksPerThread = 8;

/// The powers of all arrivals, by the bounces before them.
class Series {
 public:
  explicit Series(int length) : power_(static_cast<size_t>(length), 0.0) {}
  void add(std::span<const StoredPhoton> photons) {
    for (const StoredPhoton& p : photons)
      if (const auto n = static_cast<size_t>(p.bounces); n < power_.size()) power_[n] += double{luminance(p.power)};
  }

  /// Returns the light that would arrive later. `emitted`: all power, in place of first arrivals.
  BouncesLeft left(double emitted) const {
    const size_t n = power_.size();
    if (n < 2 || !(power_[n - 1] > 0)) return {};
    return bouncesLeft(static_cast<int>(n), std::accumulate(power_.begin() + 1, power_.end(), 0.0), power_[n - 1],
                       power_[n - 1] / (n == 2 ? emitted : power_[n - 2]));
  }

 private:
  std::vector<double> power_;
};

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

bool isSpecularForPhotons(const Attributes& attributes) {
  const auto model = photonModel(attributes.photon.shadingModel);
  return attributes.visibility.photon && model && isMirrorOrGlass(*model);
}

PhotonFigures tracePhotons(const Scene& scene, const RayScene& rays, const ShadingSystem& shading,
                           const PhotonSettings& given, const std::function<void(std::span<const StoredPhoton>)>& store,
                           const std::function<void(float)>& progress, Stats& stats, Log& log, WorkPart part) {
  const PhotonSources sources(rays, shading, given, log);
  const PhotonSettings& settings = sources.settings();
  PhotonFigures figures;
  const int arrivals = std::min(settings.mostBounces + 1, settings.maxDepth);
  const bool isAsked = given.maxDepth > 0 || arrivals < settings.maxDepth;
  Series series(arrivals);
  std::vector<std::vector<StoredPhoton>> stored;
  const size_t photonsPerWave = PhotonSources::kPhotonsPerTask * kTasksPerThread * static_cast<size_t>(threadCount());
  const std::vector<PhotonSources::PhotonRange> ranges = sources.rangesOf(part);
  const auto all =
      std::accumulate(ranges.begin(), ranges.end(), size_t{0},
                      [](size_t sum, const PhotonSources::PhotonRange& s) { return sum + s.end - s.first; });
  double power = 0;
  for (const auto& [from, first, last] : ranges) {
    for (size_t wave = first; wave < last; wave += photonsPerWave) {
      const size_t end = std::min(last, wave + photonsPerWave);
      stored.assign((end - wave + PhotonSources::kPhotonsPerTask - 1) / PhotonSources::kPhotonsPerTask, {});
      sources.trace(from, settings.seed, wave, end,
                    [&](size_t task, std::vector<StoredPhoton>&& photons) { stored[task] = std::move(photons); });
      for (const auto& photons : stored) {
        store(photons);
        series.add(photons);
        figures.stored += static_cast<int64_t>(photons.size());
      }
      if (progress)
        progress(static_cast<float>(static_cast<size_t>(figures.emitted) + end - first) / static_cast<float>(all));
    }
    figures.emitted += static_cast<int64_t>(last - first);
    power += from.source->power() * (static_cast<double>(last - first) / static_cast<double>(from.count));
  }
  stats.rays.photon += figures.emitted;
  const BouncesLeft left = series.left(power);
  figures.left = left.share;
  if (!ranges.empty() && arrivals > 1) tellBouncesLeft(left, isAsked, "photons-bounces", scene.where, log);
  return figures;
}

}  // namespace tomales

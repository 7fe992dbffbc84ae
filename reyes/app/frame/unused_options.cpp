#include "reyes/app/frame/unused_options.h"

#include <fmt/format.h>

namespace tomales {
namespace {

/// An option that only some methods of indirect light read.
struct LightOption {
  const char* name;
  bool (*differs)(const RenderSettings& given, const RenderSettings& defaults);
  bool (*isRead)(const GiMethod&);
};

bool sendsPhotons(const GiMethod& m) { return m.countsPhotons || (m.makesMaps && !m.byPointClouds); }
bool makesPhotonMaps(const GiMethod& m) { return m.makesMaps && !m.byPointClouds; }
bool makesRadiosityMaps(const GiMethod& m) { return m.mode == GiMode::Radiosity; }

using R = RenderSettings;
constexpr LightOption kLightOptions[] = {
    {"--photons", [](const R& a, const R& b) { return a.light.photons != b.light.photons; }, sendsPhotons},
    {"--photon-noise", [](const R& a, const R& b) { return a.light.photonNoise != b.light.photonNoise; },
     [](const GiMethod& m) { return m.countsPhotons; }},
    {"--atlas", [](const R& a, const R&) { return !a.stored.atlasFolder.empty(); },
     [](const GiMethod& m) { return m.makesMaps || makesRadiosityMaps(m); }},
    {"--atlas-direct", [](const R& a, const R& b) { return a.stored.atlasDirect != b.stored.atlasDirect; },
     makesPhotonMaps},
    {"--brick-maxerror", [](const R& a, const R& b) { return a.stored.brickMaxError != b.stored.brickMaxError; },
     [](const GiMethod& m) { return m.makesMaps; }},
    {"--radiosity-texels", [](const R& a, const R& b) { return a.stored.radiosityTexels != b.stored.radiosityTexels; },
     makesRadiosityMaps},
    {"--radiosity-maps", [](const R& a, const R&) { return !a.stored.radiosityFolder.empty(); }, makesRadiosityMaps},
};

/// Returns the names of the methods that read an option: "atlas, progressive and reference".
std::string readersOf(const LightOption& option) {
  std::string out, last;
  for (const GiMethod& m : kGiMethods) {
    if (!option.isRead(m)) continue;
    if (!last.empty()) out += (out.empty() ? "" : ", ") + last;
    last = m.name;
  }
  return out.empty() ? last : out + " and " + last;
}

}  // namespace

void warnOfUnusedOptions(const RenderSettings& settings, const GiMethod& method, Log& log) {
  const RenderSettings defaults;
  const auto warn = [&](const char* name, const std::string& reason) {
    log.report(Severity::Warning, "option-unused", {}, fmt::format("{} has no effect: {}", name, reason));
  };
  for (const LightOption& option : kLightOptions)
    if (option.differs(settings, defaults) && !option.isRead(method))
      warn(option.name, fmt::format("it is for --gi {}, and the light is by --gi {}", readersOf(option), method.name));
  const QualitySettings& quality = settings.quality;
  if (quality.targetError > 0 || quality.timeBudget_s > 0) return;
  const char* reason = "it is for --target-error or --time-budget";
  if (quality.pilotFrames) warn("--pilot-frames", reason);
  if (!quality.animationSettings.empty()) warn("--animation-settings", reason);
  if (quality.auditEvery != defaults.quality.auditEvery) warn("--audit-every", reason);
}

}  // namespace tomales

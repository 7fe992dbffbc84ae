#include "reyes/app/frame/held_quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "reyes/base/chunk_file.h"
#include "reyes/base/input_file.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the targets that the settings were found for.
Json purposeOf(const QualitySettings& s) {
  return {{"target_error", s.targetError}, {"target_smudges", s.targetSmudges}, {"time_budget_s", s.timeBudget_s}};
}

/// Merges a setting of two pilots. With 0 or a negative number a pilot leaves it to the scene, and the other's value
/// counts.
template <class T>
T mergedSetting(T a, T b, bool takesLarger) {
  if (!(a > 0) || !(b > 0)) return std::max(a, b);
  return takesLarger ? std::max(a, b) : std::min(a, b);
}

}  // namespace

std::vector<int> pilotsOf(const std::vector<int>& frames) {
  std::vector<int> out;
  if (frames.empty()) return out;
  for (const size_t i : {size_t{0}, frames.size() / 2, frames.size() - 1})
    if (out.empty() || out.back() != frames[i]) out.push_back(frames[i]);
  return out;
}

void hold(const LightQuality& quality, RenderSettings& settings) {
  settings.quality.isHeld = true;
  if (quality.samples > 0) settings.light.samples = quality.samples;
  if (quality.maxError >= 0) settings.light.maxError = quality.maxError;
  if (quality.lightSamples > 0) settings.light.lightSamples = quality.lightSamples;
}

void mergeQuality(HeldQuality& held, size_t world, const LightQuality& quality, const QualitySettings& settings) {
  if (world >= held.worlds.size()) {
    held.worlds.resize(world);
    held.worlds.push_back(quality);
    return;
  }
  const bool isFiner = settings.targetError > 0;
  LightQuality& q = held.worlds[world];
  q.samples = mergedSetting(q.samples, quality.samples, isFiner);
  q.maxError = mergedSetting(q.maxError, quality.maxError, !isFiner);
  q.lightSamples = mergedSetting(q.lightSamples, quality.lightSamples, isFiner);
}

std::optional<HeldQuality> readHeldQuality(const std::string& file, const QualitySettings& settings,
                                           std::string& error) {
  error = inputProblem(file);
  if (!error.empty()) return std::nullopt;
  std::ifstream in(file);
  const Json json = Json::parse(in, nullptr, false);
  try {
    if (json.at("for") != purposeOf(settings)) {
      error =
          fmt::format("it holds settings for {}, and {} is asked", json.at("for").dump(), purposeOf(settings).dump());
      return std::nullopt;
    }
    HeldQuality out;
    out.pilots = json.at("pilots").get<std::vector<int>>();
    for (const Json& w : json.at("worlds"))
      out.worlds.push_back(
          {w.at("samples").get<int>(), w.at("max_error").get<float>(), w.at("light_samples").get<int>()});
    return out;
  } catch (const Json::exception&) {
    error = "it does not hold settings of light as --animation-settings writes them";
    return std::nullopt;
  }
}

void writeHeldQuality(const std::string& file, const HeldQuality& held, const QualitySettings& settings) {
  Json json{{"for", purposeOf(settings)}, {"pilots", held.pilots}, {"worlds", Json::array()}};
  for (const LightQuality& q : held.worlds)
    json["worlds"].push_back({{"samples", q.samples}, {"max_error", q.maxError}, {"light_samples", q.lightSamples}});
  std::string why;
  if (!writeFile(file, json.dump(1) + "\n", why))
    throw WriteError(fmt::format("\"{}\" could not be written: {}", file, why));
}

}  // namespace tomales

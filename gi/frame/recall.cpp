// Looks up the answers about indirect light that an earlier pass has recorded, by what was asked.
#include <algorithm>
#include <bit>

#include "gi/frame/recall.h"
#include "reyes/base/checksum.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

uint32_t hashOf(const std::string& text) { return static_cast<uint32_t>(checksum(std::as_bytes(std::span(text)))); }

/// Hashes the part of the query that GatherSettings do not repeat.
uint32_t hashOf(const std::optional<HemisphereQuery>& q) {
  const auto bits = [](float x) { return std::bit_cast<uint32_t>(x); };
  return q ? hashCombine(bits(q->bias), bits(q->falloff), static_cast<uint32_t>(q->falloffMode),
                         static_cast<uint32_t>(q->sides) | static_cast<uint32_t>(q->radiance) << 8 |
                             (q->mode ? static_cast<uint32_t>(*q->mode) + 1 : 0) << 9 |
                             static_cast<uint32_t>(q->diffuseLimit) << 16,
                         hashOf(q->subset), hashOf(q->excludeSubset))
           : 0;
}

/// Hashes what the records of a cache say at a place, as long as none comes or goes.
uint64_t hashOf(const GiState& state, const PreparedCache& prepared, const IrradiancePlace& at) {
  const struct {
    vec3 position, normal, shadingNormal;
    float pixelSize;
    uint64_t cache, gains;
  } asked{at.position,
          at.normal,
          at.shadingNormal,
          at.pixelSize,
          static_cast<uint64_t>(&prepared - state.caches.data()),
          checksum(std::as_bytes(std::span(state.gains)))};
  static_assert(sizeof asked == 14 * sizeof(uint32_t), "no padding, whose bytes would be names too");
  return checksum(std::as_bytes(std::span(&asked, 1)));
}

}  // namespace

IndirectAnswer gatherOrRecall(const GiState& state, const GatherPoint& point, const GatherSettings& settings,
                              RayAnswers* answers) {
  const struct {
    vec3 position, normal;
    uint32_t key, seed;
    int group, samples;
    float maxDistance, time;
    vec3 drift;
    uint32_t light, indirect, subset, radiosity, question;
  } asked{point.position,
          point.normal,
          point.key,
          settings.seed,
          point.group,
          settings.samples,
          settings.maxDistance,
          point.time,
          point.drift,
          static_cast<uint32_t>(settings.light),
          static_cast<uint32_t>(settings.indirect) | static_cast<uint32_t>(!settings.specularRaysSeeLights) << 1,
          hashOf(settings.subset),
          state.settings.mode == GiMode::Radiosity,
          hashOf(settings.asked)};
  static_assert(sizeof asked == 20 * sizeof(uint32_t), "no padding, whose bytes would be names too");
  const uint64_t name = answers ? checksum(std::as_bytes(std::span(&asked, 1))) : 0;
  const std::span<const std::string> groups = shareGroupsFor(state, settings);
  const auto mixed = [&](IndirectAnswer answer, const std::vector<vec3>& gains) {
    return groups.empty() || gains.empty() ? answer : withGains(std::move(answer), gains);
  };
  if (answers)
    if (const auto it = answers->indirect.find(name);
        it != answers->indirect.end() && it->second.shares.size() == groups.size())
      return mixed(it->second, state.gains);
  const RayTools* tools = gatherTools(state);
  if (!tools) return {vec3(settings.isOcclusion() ? 1.0f : 0.0f), {point.normal, point.normal, point.normal}, {}};
  const IrradianceRecord record = gather(*tools->rays, *tools->shading, point, settings, knownLightFor(state, settings),
                                         state.stats, nullptr, groups);
  IndirectAnswer answer{record.light.E, {record.dominant[0], record.dominant[1], record.dominant[2]}, {}};
  for (const IrradianceExpansion& share : record.shares) answer.shares.push_back(share.E);
  if (answers && answers->recording) answers->indirect[name] = answer;
  return mixed(answer, state.gainsOfNew);
}

BatchLookup recallOrLookUp(const GiState& state, const PreparedCache& prepared, const GatherPlaces& places,
                           const AskedPoints& asked, const ShadeContext& context) {
  BatchLookup out = placesOf(places, asked);
  auto& known = context.answers->interpolated;
  std::vector<uint64_t> names;
  for (const IrradiancePlace& at : out.at) names.push_back(hashOf(state, prepared, at));
  if (std::ranges::all_of(names, [&](uint64_t name) { return known.contains(name); })) {
    for (size_t k = 0; k < names.size(); ++k) {
      const std::optional<IndirectAnswer>& answer = known.at(names[k]);
      out.known[k].weight = answer ? 1.0f : 0.0f;
      if (!answer) continue;
      out.known[k].E = answer->E;
      std::ranges::copy(answer->dominant, out.known[k].dominant);
    }
    return out;
  }
  out = lookUp(state, &prepared, places, asked, context);
  for (size_t k = 0; k < names.size(); ++k) {
    const IrradianceEstimate& e = out.known[k];
    known[names[k]].reset();
    if (e.weight > 0) known[names[k]] = IndirectAnswer{e.E, {e.dominant[0], e.dominant[1], e.dominant[2]}, {}};
  }
  return out;
}

}  // namespace tomales

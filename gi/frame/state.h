// Private to gi: the members of GiServices, and the parts that it is made of. Space: current. Irradiance: E/pi.
#pragma once
#include "gi/frame/asked_points.h"
#include "gi/frame/learnt_light.h"
#include "gi/frame/measured_light.h"
#include "gi/services.h"

#include <mutex>

namespace tomales {

/// The light of caches under the gains of groups, made when it is first asked for.
struct MixedLight {
  std::once_flag once;
  /// Indexed as GiState::caches (IrradianceCache::cachedMix).
  std::vector<std::span<const IrradianceExpansion>> ofCaches;
};

struct GiState {
  const Scene& scene;
  const Camera& camera;
  const RaySource rays;
  const ShadingSystem& shading;
  GiSettings settings;  ///< Constant while anything is gathered or shaded.
  Stats& stats;
  mutable std::unique_ptr<const IrradianceAtlas> atlas{};  ///< Set in GiMode::Atlas and Baked alone.
  std::vector<PreparedCache> caches{};                     ///< Written by fillCaches(), frozen while shading.
  std::optional<Emitters> emitters{};                      ///< Emitters that are known without rays.
  std::shared_ptr<LearntLight> learnt = std::make_shared<LearntLight>();  ///< Written by fillCaches().
  /// Queries of each group; written by learnHemisphereQueries() alone.
  mutable std::vector<std::vector<HemisphereQuery>> hemispheresAsked{};
  Checkpoint* checkpoint = nullptr;                          ///< Null if nothing is kept for a later run.
  bool cachesGiven = false;                                  ///< The caches were not gathered for this very frame.
  std::optional<PixelRect> anew{};                           ///< Pixels whose given records have been taken out.
  AtlasSource atlasSource{};                                 ///< May be empty.
  HitRadianceSource hitRadianceSource{};                     ///< May be empty.
  mutable std::unique_ptr<const HitRadiance> hitRadiance{};  ///< Set in GiMode::Radiosity alone.
  mutable std::once_flag sourcesOnce{};
  GiServices::BounceCost bounceCost{};        ///< That of the last gather pass.
  std::optional<PhotonPasses> passes{};       ///< Empty: no photons are counted.
  std::unique_ptr<MeasuredLight> measured{};  ///< Written by measureLight(), frozen while shading.
  /// Indexed by group: 1 if photons, and not paths, bring the light of lamps and skies by its mirrors and glass.
  std::vector<uint8_t> groupsWithCaustics{};
  std::vector<std::string> groups{};    ///< The groups of lights whose shares records hold; empty: none.
  std::vector<vec3> gains{};            ///< One for each of these groups; empty if all are 1.
  std::vector<vec3> gainsOfNew{};       ///< The same for light that is gathered while shading.
  std::unique_ptr<MixedLight> mixed{};  ///< Light mixed with these gains; null if they are empty.
  /// Call this when the gains or the records have changed.
  void mixAnew() { mixed = gains.empty() ? nullptr : std::make_unique<MixedLight>(); }
  /// Light of the records, indexed as `caches`, with another draw of each record's noise; empty before redrawRecords().
  std::vector<std::vector<IrradianceExpansion>> redrawn{};
};

/// Returns what is known of the light that a record with these settings gathers; nothing for occlusion.
inline KnownLight knownLightFor(const GiState& state, const GatherSettings& settings) {
  return settings.isOcclusion() ? KnownLight{} : KnownLight{&state.learnt->spots, state.hitRadiance.get()};
}
/// Returns the groups of lights whose shares such a record holds; none for occlusion.
inline std::span<const std::string> shareGroupsFor(const GiState& state, const GatherSettings& settings) {
  return settings.isOcclusion() ? std::span<const std::string>() : std::span<const std::string>(state.groups);
}

/// Returns what gathering needs, atlas and radiosity maps included; null in the case that RaySource describes.
const RayTools* gatherTools(const GiState&);

}  // namespace tomales

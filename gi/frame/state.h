// Private to gi: the members of GiServices, and the parts that it is made of.
#pragma once
#include "gi/frame/learnt_light.h"
#include "gi/frame/measured_light.h"
#include "gi/services.h"

#include <mutex>

namespace tomales {

/// The light of caches under the gains of groups, made when it is first asked for.
struct MixedLight {
  std::once_flag once;
  std::vector<std::span<const LightShare>> ofCaches;  ///< Indexed as GiState::caches (IrradianceCache::keptMix).
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
  KeptWork* kept = nullptr;                                  ///< Null if nothing is kept for a later run.
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
  std::vector<uint8_t> focusing{};
  std::vector<std::string> groups{};    ///< The groups of lights whose shares records hold; empty: none.
  std::vector<vec3> gains{};            ///< One for each of these groups; empty if all are 1.
  std::vector<vec3> gainsOfNew{};       ///< The same for light that is gathered while shading.
  std::unique_ptr<MixedLight> mixed{};  ///< Light mixed with these gains; null if they are empty.
  /// Call this when the gains or the records have changed.
  void mixAnew() { mixed = gains.empty() ? nullptr : std::make_unique<MixedLight>(); }
  /// Light of the records, indexed as `caches`, with another draw of each record's noise; empty before redrawRecords().
  std::vector<std::vector<LightShare>> redrawn{};
};

/// Returns what gathering needs, atlas and radiosity maps included; null in the case that RaySource describes.
const RayTools* gatherTools(const GiState&);

/// Returns the settings of an indirect light as this group sees them: the command line wins over the group's
/// attributes, and those over the light.
GatherPlan planFor(const GiState&, int group, const IndirectQuery&);

GatherPlan planFor(const GiState&, int group, const HemisphereQuery&);

/// Finds the cache that serves a plan, if there is one. Records that were given serve even where a light or an option
/// has since been changed: preferably those whose plan differs in its rays alone, else those for the same question.
std::vector<PreparedCache>::const_iterator preparedFor(const GiState&, const GatherPlan&);

/// Returns what a cache with this error function has at `maxError`.
CacheSettings cacheSettings(ErrorFunction, float maxError);

/// Tells whether indirect light comes from an irradiance cache.
bool interpolatesIndirect(const GiState&);

/// Runs the shaders of each group that asksHemispheres() at a few of its visible points, to learn what they ask.
void learnHemisphereQueries(GiState&, const DeepFrame& layout, const TileReader&, const std::atomic<bool>* cancelled);

/// Returns the number of diffuse bounces of a light.
int bouncesFor(const GiState&, const IndirectQuery&);
/// Returns the same for the paths of an audit (ShadeContext::auditPaths), which stand for all light that the method
/// brings, by maps or otherwise.
int auditBouncesFor(const GiState&, const IndirectQuery&);

/// Root of the area that a pixel projects onto the plane through P with unit normal n (approximate-gi
/// section 4.5).
float projectedPixelSize(const Camera&, const vec3& P, const vec3& n);

/// The places where the indirect light of a batch is gathered and looked up (approximate-gi 4.5): its points, or the
/// values of its primitive variable "gatherP", on the side of the normal without bumps or of "gatherN". Points with
/// equal values share a place, as all points of one hair share its root.
class GatherPlaces {
 public:
  GatherPlaces(const GiState&, const ShadePoints&);
  GatherPoint at(int i) const;
  /// Returns the place at(i), without what only rays need. `normal`: the shading normal.
  IrradiancePlace lookupAt(int i, const vec3& normal) const;
  /// Returns the normal that records are extrapolated to: the shading normal, unless "gatherN" names another.
  vec3 shading(int i, const vec3& normal) const { return normals_ < 0 ? normal : this->normal(i); }
  /// Sets the start of a ray along its direction from place i, at a time of the shutter.
  void aim(const RayScene&, int i, float time, Ray&) const;

 private:
  vec3 normal(int i) const;
  vec3 named(int offset, int i) const;

  const GiState& state_;
  const ShadePoints& points_;
  int positions_, normals_;  ///< Offsets of the primitive variables; -1: the group has none.
  bool bumped_;
};

/// The answers of records at the active points of a batch.
struct BatchLookup {
  std::vector<int> points;                ///< Indices of the points in the batch.
  std::vector<IrradiancePlace> at;        ///< The places where they look.
  std::vector<IrradianceEstimate> known;  ///< The answers; their weight is 0 where no record serves.
};

/// prepared: one of state.caches, or null, which knows nothing. Counts lookups and hits.
BatchLookup lookUp(const GiState&, const PreparedCache* prepared, const GatherPlaces&, const ShadePoints&,
                   const uint8_t* active, TmConstVec3 N, const ShadeContext&);

/// Returns the places where the active points look, with no answer yet.
BatchLookup placesOf(const GatherPlaces&, const ShadePoints&, const uint8_t* active, TmConstVec3 N);
/// Does the same as lookUp(), but without the cache if context.answers, which must not be null, holds an answer for
/// each place.
BatchLookup recallOrLookUp(const GiState&, const PreparedCache&, const GatherPlaces&, const ShadePoints&,
                           const uint8_t* active, TmConstVec3 N, const ShadeContext&);

/// Returns the light of a cache's records under the gains; empty if that is their own.
std::span<const LightShare> mixedLight(const GiState&, size_t cache);

/// Returns the light of a cache's records as it would be with other random numbers. Each record is made brighter or
/// darker by a draw of its noise, times the root of 2: so much do two independent pictures differ. mixed: mixedLight()
/// of the cache.
std::vector<LightShare> redrawn(const IrradianceCache&, std::span<const LightShare> mixed);

/// Phase of the gather pass in which the nearest point of a pixel is considered: 0 is a lattice of stride 16,
/// and each phase after it halves the area for each point, down to every pixel (quincunx first, then the rest
/// of the finer lattice).
constexpr int kLatticePhases = 9;
int latticePhase(int x, int y);

/// Returns E/pi that the gather pass has left at a place; empty where no record serves.
std::optional<vec3> gatheredOverPi(const GiState&, const GatherPoint& at);

/// Implements GiServices::bake().
void bakeLight(const GiState&, const DeepFrame& layout, const TileReader&, const std::filesystem::path& folder,
               const MapNames&, uint64_t world);

/// Implements GiServices::gatherPass().
void fillCaches(GiState&, const DeepFrame& layout, const TileReader&, const std::function<void(float)>& progress,
                const std::atomic<bool>* cancelled, const std::function<void(int stride)>& covered);

/// Notes where shaders ask for indirect light, and counts photons there, if state.passes says how many.
void measureLight(GiState&, const DeepFrame& layout, const TileReader&, const std::function<void(float)>& progress,
                  const std::atomic<bool>* cancelled);
/// Notes the places while measureLight() asks for them, and answers that they are dark. Returns false at any other
/// time.
bool noteMeasured(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N, int bounces,
                  const ShadeContext&, const IndirectResult& out);
/// Adds what has been measured to E, where the eye looks and by mirrors and glass.
void addMeasured(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N, int bounces,
                 const ShadeContext&, const IndirectResult& out);

/// Returns the time of ray `number` of the `count` that leave a point: the point's own time, or a stratified one if the
/// point is seen over the whole shutter and its object samples motion. Successive points of one SampleName continue
/// each other's sequence.
float rayTime(const RayScene&, const ShadePoints&, int i, int number, int count, uint32_t seed);

/// Moves the start of a ray to where the point is at that time, keeping its end if it has one, and prepares it.
void aim(const RayScene&, const ShadePoints&, int i, float time, Ray&);

/// Returns the filter for rays that a shader of an object with these attributes traces.
RayFilter filterOf(const RayScene&, const RayQuery&, const Attributes&);
/// Replaces the hit list by the bias, if the shader gives one.
void setBias(const RayQuery&, Ray&);

/// Returns the context of the points that a shader's rays meet: their depths and limits. None if no ray is traced.
std::optional<ShadeContext> contextOfHits(const GiState&, const ShadePoints&, const RayQuery&, const ShadeContext&);

/// Implements ShadeServices::trace().
void traceForShader(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 P, TmConstVec3 direction,
                    const RayQuery&, const ShadeContext&, const RayResult&);

/// Gathers at a point that no record serves, or takes the recorded answer if `answers` has one.
IndirectAnswer gatherOrRecall(const GiState&, const GatherPoint&, const GatherSettings&, RayAnswers* answers);

/// Returns the unit normal that a shader asks with; the one facing the eye if it has none.
vec3 unitNormal(const ShadePoints& points, TmConstVec3 N, int i);
/// Writes E/pi and dominant directions to element i of a result.
void store(const IndirectResult& out, int i, const vec3& E, const vec3 dominant[3]);

/// Implements indirectDiffuse() in GiMode::Baked, at any depth.
void bakedIndirect(const GiState&, const ShadePoints&, const uint8_t* active, const IndirectResult& out);

// Implements indirectDiffuse() in the other modes. Pre: the light may still bounce at these points.
void interpolateIndirect(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N, const IndirectQuery&,
                         const ShadeContext&, const IndirectResult& out);
void traceIndirect(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N, const IndirectQuery&,
                   const ShadeContext&, int bounces, const IndirectResult& out);
/// Implements ShadeServices::indirectAlong(); likewise.
void traceAlong(const GiState&, const ShadePoints&, const uint8_t* active, const LobeWay&, const IndirectQuery&,
                const ShadeContext&, int bounces, TmVec3 out);
/// Sets E/pi at points where the atlas does not tell two sides of a wall apart: by a path from each, whose hits look up
/// what is stored there.
void traceToStored(const GiState&, const ShadePoints&, const std::vector<int>& which, TmVec3 E);
/// Implements ShadeServices::interpolatedHemisphere().
bool interpolateHemisphere(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N,
                           const HemisphereQuery&, const ShadeContext&, TmVec3 out);
/// Implements indirectDiffuse() at hits of gather rays: from the caches of further bounces, or traced.
void bounceIndirect(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N, const IndirectQuery&,
                    const ShadeContext&, int bounces, const IndirectResult& out);

}  // namespace tomales

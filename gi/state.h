// Private to gi: what GiServices holds, and the parts that it is made of.
#pragma once
#include "gi/bounce_caches.h"
#include "gi/services.h"

#include <mutex>

namespace tomales {

struct GiState {
  const Scene& scene;
  const Camera& camera;
  const RaySource rays;
  const ShadingSystem& shading;
  const GiSettings settings;
  Stats& stats;
  mutable std::unique_ptr<const IrradianceAtlas> atlas;               ///< GiMode::Atlas and Baked alone.
  std::vector<PreparedCache> caches;                                  ///< Written by fillCaches, frozen while shading.
  std::optional<Emitters> emitters;                                   ///< Known without rays.
  BrightSpots spots{};                                                ///< Likewise,
  BounceCaches bounces{};                                             ///< and these.
  mutable std::vector<std::vector<OcclusionQuery>> occlusionAsked{};  ///< By each group: written by rehearse() alone.
  bool cachesGiven = false;                                           ///< Not gathered for this very frame.
  std::optional<PixelRect> anew{};                         ///< Pixels out of which given records have been taken.
  AtlasSource atlasSource{};                               ///< May be empty,
  RadiositySource radiositySource{};                       ///< and this.
  mutable std::unique_ptr<const HitRadiance> radiosity{};  ///< GiMode::Radiosity alone.
  mutable std::once_flag sourcesOnce{};
};

/// What it takes to gather, atlas and radiosity maps included; null as RaySource says.
const RayTools* gatherTools(const GiState&);

/// The settings of an indirect light as this group sees them: the command line wins over the group's
/// attributes, and those over the light.
GatherPlan planFor(const GiState&, int group, const IndirectQuery&);

GatherPlan planFor(const GiState&, int group, const OcclusionQuery&);

/// Does indirect light come from an irradiance cache?
bool interpolatesIndirect(const GiState&);

/// Runs the shaders of each group that asksOcclusion() at one of its visible points, to learn what they ask.
void rehearse(GiState&, const DeepFrame& layout, const TileReader&, const std::atomic<bool>* cancelled);

/// Diffuse bounces that a light accounts for.
int bouncesFor(const GiState&, const IndirectQuery&);

/// Root of the area that a pixel projects onto the plane through P with unit normal n (approximate-gi
/// section 4.5).
float projectedPixelSize(const Camera&, const vec3& P, const vec3& n);

/// Where the indirect light of a batch is gathered and looked up (approximate-gi 4.5): at its points, or where their
/// primitive variable "gatherP" says, on the side of the normal without bumps or of "gatherN". The same places for all
/// that names them alike, as all of one hair does its root.
class GatherPlaces {
 public:
  GatherPlaces(const GiState&, const ShadePoints&);
  GatherPoint at(int i) const;
  /// The same without what rays take; `normal`: that of shading.
  IrradiancePlace lookupAt(int i, const vec3& normal) const;
  /// The normal that light is turned to there: that of shading, unless another is named.
  vec3 shading(int i, const vec3& normal) const { return normals_ < 0 ? normal : this->normal(i); }
  /// The start of a ray along `direction` from there, at a time of the shutter.
  void aim(const RayScene&, int i, float time, Ray&) const;

 private:
  vec3 normal(int i) const;
  vec3 named(int offset, int i) const;

  const GiState& state_;
  const ShadePoints& points_;
  int positions_, normals_;  ///< Offsets of the primitive variables; -1: none.
  bool bumped_;
};

/// What records say of the active points of a batch.
struct BatchLookup {
  std::vector<int> points;                ///< Of the batch,
  std::vector<IrradiancePlace> at;        ///< where they look,
  std::vector<IrradianceEstimate> known;  ///< and what is there; of weight 0 where no record serves.
};

/// cache: null knows nothing. Counts what is looked up and found.
BatchLookup lookUp(const GiState&, const IrradianceCache* cache, const GatherPlaces&, const ShadePoints&,
                   const uint8_t* active, TmConstVec3 N);

/// Phase of the gather pass in which the nearest point of a pixel is considered: 0 is a lattice of stride 16,
/// and each phase after it halves the area for each point, down to every pixel (quincunx first, then the rest
/// of the finer lattice).
constexpr int kLatticePhases = 9;
int latticePhase(int x, int y);

/// E/pi as the gather pass has left it there; nothing where no record serves.
std::optional<vec3> gatheredOverPi(const GiState&, const GatherPoint& at);

/// GiServices::bake().
void bakeLight(const GiState&, const DeepFrame& layout, const TileReader&, const std::filesystem::path& folder,
               const MapNames&, uint64_t world);

/// GiServices::gatherPass().
void fillCaches(GiState&, const DeepFrame& layout, const TileReader&, const std::function<void(float)>& progress,
                const std::atomic<bool>* cancelled, const std::function<void(int stride)>& covered);

/// When ray `number` of the `count` that leave a point is shot: the point's own time, or a stratified one if it is seen
/// over the whole shutter and its object samples motion. Successive points of one SampleName continue each other's
/// sequence.
float rayTime(const RayScene&, const ShadePoints&, int i, int number, int count, uint32_t seed);

/// Moves the start of a ray to where the point is at that time, keeping its end if it has one, and prepares it.
void aim(const RayScene&, const ShadePoints&, int i, float time, Ray&);

/// What the rays of a call in a shader of an object with these attributes may meet.
RayFilter filterOf(const RayScene&, const RayQuery&, const Attributes&);
/// A bias that the shader gives takes the place of the hit list.
void setBias(const RayQuery&, Ray&);

/// ShadeServices::trace().
void traceForShader(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 P, TmConstVec3 direction,
                    const RayQuery&, const ShadeContext&, const RayResult&);

/// Of a point that no record serves, or what rays answered there before, if `answers` has it.
IndirectAnswer gatherOrRecall(const GiState&, const GatherPoint&, const GatherSettings&, RayAnswers* answers);

/// The normal that a shader asks with, of unit length; facing if it has none.
vec3 unitNormal(const ShadePoints& points, TmConstVec3 N, int i);
/// E and dominant directions into element i of a result.
void store(const IndirectResult& out, int i, const vec3& E, const vec3 dominant[3]);

/// indirectDiffuse() in GiMode::Baked, at any depth.
void bakedIndirect(const GiState&, const ShadePoints&, const uint8_t* active, const IndirectResult& out);

// indirectDiffuse() in the others. Pre: the light may still bounce at these points.
void interpolateIndirect(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N, const IndirectQuery&,
                         const ShadeContext&, const IndirectResult& out);
void traceIndirect(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N, const IndirectQuery&,
                   const ShadeContext&, int bounces, const IndirectResult& out);
/// ShadeServices::interpolatedOcclusion().
bool interpolateOcclusion(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N,
                          const OcclusionQuery&, const ShadeContext&, float* covered);
/// At what gather rays hit: from the caches of further bounces, or traced.
void bounceIndirect(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N, const IndirectQuery&,
                    const ShadeContext&, int bounces, const IndirectResult& out);

}  // namespace tomales

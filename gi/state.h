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
  mutable std::unique_ptr<const IrradianceAtlas> atlas;  ///< GiMode::Atlas and Baked alone.
  std::vector<PreparedCache> caches;  ///< Written by fillCaches, frozen while shading.
  std::optional<Emitters> emitters;   ///< Known without rays.
  BrightSpots spots{};                ///< Likewise,
  BounceCaches bounces{};             ///< and these.
  bool cachesGiven = false;           ///< Not gathered for this very frame.
  AtlasSource atlasSource{};          ///< May be empty.
  mutable std::once_flag atlasOnce{};
};

/// What it takes to gather, the atlas included; null as RaySource says.
const RayTools* gatherTools(const GiState&);

/// The settings of an indirect light as this group sees them: the command line wins over the group's
/// attributes, and those over the light.
GatherPlan planFor(const GiState&, int group, const IndirectQuery&);

/// Diffuse bounces that a light accounts for.
int bouncesFor(const GiState&, const IndirectQuery&);

/// Root of the area that a pixel projects onto the plane through P with unit normal n (approximate-gi
/// section 4.5).
float projectedPixelSize(const Camera&, const vec3& P, const vec3& n);

/// Where irradiance is gathered: the normal on the viewer's side without bumps (approximate-gi 4.5). A displacement shader of a group
/// without displacement bound moves no point, so that there it is the geometric normal.
vec3 gatherNormal(const GiState&, const ShadePoints& points, int i);

/// Phase of the gather pass in which the nearest point of a pixel is considered: 0 is a lattice of stride 16,
/// and each phase after it halves the area for each point, down to every pixel (quincunx first, then the rest
/// of the finer lattice).
constexpr int kLatticePhases = 9;
int latticePhase(int x, int y);

/// E/pi as the gather pass has left it at a point, without bumps; nothing where no record serves.
std::optional<vec3> gatheredOverPi(const GiState&, const ShadePoints& points, int i);

/// GiServices::bake().
void bakeLight(const GiState&, const DeepFrame& layout, const TileReader&, const std::filesystem::path& folder, const MapNames&, uint64_t world);

void fillCaches(GiState&, const DeepFrame& layout, const TileReader&, const std::function<void(float)>& progress,
                const std::atomic<bool>* cancelled);

/// When ray `number` of the `count` that leave a point is shot: the point's own time, or a stratified one if it is seen over the
/// whole shutter and its object samples motion. Successive points of one SampleName continue each other's sequence.
float rayTime(const RayScene&, const ShadePoints&, int i, int number, int count, uint32_t seed);

/// Moves the start of a ray to where the point is at that time, keeping its end if it has one, and prepares it.
void aim(const RayScene&, const ShadePoints&, int i, float time, Ray&);

/// What the rays of a call in a shader of an object with these attributes may meet.
RayFilter filterOf(const RayScene&, const RayQuery&, const Attributes&);
/// A bias that the shader gives takes the place of the hit list.
void setBias(const RayQuery&, Ray&);

/// ShadeServices::trace().
void traceForShader(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 P, TmConstVec3 direction, const RayQuery&,
                    const ShadeContext&, const RayResult&);

/// E and dominant directions into element i of a result.
void store(const IndirectResult& out, int i, const vec3& E, const vec3 dominant[3]);

/// indirectDiffuse() in GiMode::Baked, at any depth.
void bakedIndirect(const GiState&, const ShadePoints&, const uint8_t* active, const IndirectResult& out);

// indirectDiffuse() in the others. Pre: the light may still bounce at these points.
void interpolateIndirect(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N,
                         const IndirectQuery&, const ShadeContext&, const IndirectResult& out);
void traceIndirect(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N,
                   const IndirectQuery&, const ShadeContext&, int bounces, const IndirectResult& out);
/// At what gather rays hit: from the caches of further bounces, or traced.
void bounceIndirect(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N,
                    const IndirectQuery&, const ShadeContext&, int bounces, const IndirectResult& out);

}  // namespace tomales

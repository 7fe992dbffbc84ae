// The seams of shading: what a batch of points is told of how it is shaded, and what it may ask of those who know more
// than the points (ray tracing, global illumination, point clouds). Irradiance: all light is in the RSL convention,
// E/pi.
#pragma once
#include <optional>

#include "gi/error_function.h"
#include "gi/method.h"
#include "reyes/points.h"
#include "reyes/ray_answers.h"
#include "reyes/state.h"

namespace tomales {

enum class RayKind : uint8_t {
  Camera,        ///< Visible micropolygons: the whole shader.
  Diffuse,       ///< Hits of gather rays: direct light, diffuse component only, no emission of area lights
                 ///< (approximate-gi 4.1, 4.2).
  Specular,      ///< Hits of reflected and refracted rays: the whole shader, and the emission of area lights.
  Transmission,  ///< What shadow rays pass through: opacity alone, no light.
};

/// What a batch is lit by.
enum class Illumination : uint8_t {
  Lights,           ///< Those of the scene.
  Stored,           ///< ShadeServices::storedIrradiance alone, as one light along the normal.
  Unit,             ///< E/pi = 1 everywhere, likewise: what comes back is the diffuse reflectance.
  None,             ///< Nothing: what comes back is emitted.
  LightsAndStored,  ///< Both of the first two: what is stored leaves out what comes straight from lights.
};
enum class HitSides : uint8_t { Both, Front, Back };

/// A value of what a ray met, by its RSL gather() name, into `floats` (1 or 3) arrays of the caller.
struct RayOutput {
  std::string name;
  int floats = 1;
  float* c[3] = {nullptr, nullptr, nullptr};
};

/// Why and how a batch is being shaded.
struct ShadeContext {
  RayKind kind = RayKind::Camera;
  int depth = 0;  ///< Diffuse bounces between the eye and these points.
  uint32_t seed = 0;
  int lightSamples = 0;    ///< Samples of each area light and of the sky; 0: as many as the light asks for.
  bool indirect = true;    ///< Run indirect lights.
  bool direct = true;      ///< Run the others where the eye looks.
  bool variables = false;  ///< Store what outputOf(options) lists.
  const std::vector<RayOutput>* told =
      nullptr;  ///< Store these instead, of "surface:NAME" the outputs of the shader; NaN: it has none of this name.
  Illumination light = Illumination::Lights;
  int specularDepth = 0;  ///< Specular bounces between the eye and these points.
  int diffuseLimit = 1 << 20,
      specularLimit = 1 << 20;  ///< Depths at which no ray follows, set by the objects on the way.
  std::string label{};          ///< Of the ray that came here.
  bool lampsGlow = true;        ///< For that ray.
  bool mirrored =
      true;  ///< Specular rays bring lamps and skies: not where photons have brought what comes from them by mirrors.
  bool highlights = false;  ///< Diffuse rays bring highlights too: those of the reference path tracer.
  RayAnswers* answers =
      nullptr;             ///< Of this batch: asked before shadow and gather rays are traced. Null: all are traced.
  bool sketch = false;     ///< Shaders run for a look in between: nothing is baked or printed.
  bool rehearsal = false;  ///< Shaders run only to learn what they ask: no ray is traced, and nothing baked or printed.
  float importance = 1;    ///< Of what is seen here, for the eye.
  int chunk = 0;           ///< Set by ShadingSystem: which part of the batch is being shaded.
};

/// What one set of rays of a shader's call asks.
struct RayQuery {
  RayKind kind = RayKind::Specular;
  float maxDistance = 1e30f;
  float bias = -1;  ///< < 0: as the object's attributes say.
  std::string label, subset, excludeSubset;
  HitSides sides = HitSides::Both;
  std::optional<HitMode> mode;  ///< Empty: as the attributes of what is met say.
  float opacityThreshold = 1;   ///< A ray goes on behind what is transparent until this much is covered.
  int number = 0, count = 1;    ///< These are rays `number` of `count` from each point.
  bool lampsGlow = true;        ///< Area lights are seen.
  float importance = 1;         ///< Of what these rays bring.
  const float
      *radius = nullptr,
      *spread = nullptr;  ///< Of the footprint of each ray, at its start and added for each unit of length. Null: none.
};

/// Arrays for count() points; null pointers: not wanted.
struct RayResult {
  float* distance = nullptr;   ///< kInfinity: nothing was met, and no output set.
  TmVec3 color{}, opacity{};   ///< Of all that the ray went through,
  float* effective = nullptr;  ///< and with them the mean distance of what covers it; kInfinity: nothing does.
  uint8_t* leaves = nullptr;   ///< 1: the ray was traced and ends nowhere, whatever it has passed that is transparent.
  std::vector<RayOutput> outputs;  ///< Of the first hit.
};

/// What an indirect light asks for where it lights (docs/gi.md).
struct IndirectQuery {
  int samples = 600;
  float maxError = 1, maxDistance = 1e30f;
  ErrorFunction errorFunction = ErrorFunction::Screen;
  std::string subset;
  int bounces = 1;
};

/// What indirect lights ask of a frame as a whole.
struct IndirectRequest {
  const GiMethod* method = giMethodOfRadiance("shader");
  std::string atlas;           ///< Folder of the maps that gather rays look up; empty: none is named.
  std::optional<int> bounces;  ///< Of photons, if the scene says it.
};

/// What a volume shader says of the air to photons: for each unit of length of the world, by colour.
struct MediumColors {
  vec3 scattering{0.0f}, absorption{0.0f};
};

/// occlusion() of the hemisphere, weighted by the cosine, where its answers may be interpolated.
struct OcclusionQuery {
  int samples = 1;
  float maxDistance = 1e30f, bias = -1;
  float falloff = 0;
  int falloffMode = 0;
  float maxVariation = 0;  ///< How far they may be off.
  std::string subset, excludeSubset;
  HitSides sides = HitSides::Both;
  bool operator==(const OcclusionQuery&) const = default;

  /// How much of a ray is covered by what it meets at a distance.
  float coveredAt(float distance) const {
    if (!(distance < 1e30f)) return 0;
    if (falloff <= 0) return 1;
    return falloffMode == 1 ? std::pow(std::max(0.0f, 1 - distance / maxDistance), falloff)
                            : std::exp(-falloff * distance);
  }
};

/// Arrays for count() points. E is E/pi.
struct IndirectResult {
  TmVec3 E;
  TmVec3 dominant[3];  ///< Unit; for red, green, blue. Null pointers: not wanted.
};

/// Points of area lights, as others see them. Arrays of one length.
struct EmitterPoints {
  TmVec3 P, N;         ///< N: unit, RISpec side.
  float* density;      ///< With which samples fall there, over solid angle; 0: nothing shines from there.
  float* meetDensity;  ///< The same where meetEmitter() finds them too; else 0.
};

/// Which shadow rays of a light: sample `sample` of `samples`, towards a point or (solar) to infinity.
struct ShadowRays {
  bool solar = false;
  int sample = 0, samples = 1;
  const RayQuery* query = nullptr;  ///< Of transmission() in a shader.
};

/// The seam to ray tracing and GI (implemented in gi/services, injected by reyes/app). Batched; obeys `active`.
class ShadeServices {
 public:
  virtual ~ShadeServices() = default;

  /// Multiplies `light` by the fraction that arrives at each point from P + toward (solar: from infinity along it).
  /// Where things move, it is the mean over the times at which the points are seen.
  virtual void transmission(const ShadePoints& points, const uint8_t* active, TmConstVec3 toward,
                            const ShadowRays& rays, const ShadeContext& context, TmVec3 light) const = 0;

  /// One ray from P along the unit `direction` for each active point. Where the depth of rays is exhausted, none is
  /// traced.
  virtual void trace(const ShadePoints& points, const uint8_t* active, TmConstVec3 P, TmConstVec3 direction,
                     const RayQuery& query, const ShadeContext& context, const RayResult& result) const = 0;

  /// A point on area light `light` for each xi in [0,1)^2, as seen from `from`. Returns false if the light has no
  /// geometry.
  virtual bool sampleEmitter(int light, int count, TmConstVec3 from, const float* xi0, const float* xi1,
                             const EmitterPoints& out) const = 0;
  /// The nearest point that shines along each unit direction, of those emitters of the light whose shape is simple.
  virtual void meetEmitter(int light, int count, TmConstVec3 from, TmConstVec3 direction,
                           const EmitterPoints& out) const = 0;

  /// Share of the hemisphere around N that is covered, interpolated. False: nothing is known, `covered` is left alone
  /// and rays must tell.
  virtual bool interpolatedOcclusion(const ShadePoints& points, const uint8_t* active, TmConstVec3 N,
                                     const OcclusionQuery& query, const ShadeContext& context, float* covered) const;

  /// E/pi that an earlier pass stored around each point; kArea of the points is what to average over. Zero where there
  /// is none.
  virtual void storedIrradiance(const ShadePoints& points, const uint8_t* active, TmVec3 E) const;
  /// How far in front of the samples of an area light something that stands for it in rays may be: shadow rays end
  /// before that.
  virtual float emitterReach(int light) const = 0;

  /// Indirect diffuse light on the side of N.
  virtual void indirectDiffuse(const ShadePoints& points, const uint8_t* active, TmConstVec3 N,
                               const IndirectQuery& query, const ShadeContext& context, IndirectResult out) const = 0;
};

/// Data in space that shaders keep and look up: bake3d(), texture3d(). Arrays of one length, in the space of the file.
struct CloudQuery {
  std::string file;
  int count = 0;
  const uint8_t* active = nullptr;
  TmConstVec3 P{}, N{};  ///< N: unit or zero.
  const float* radius = nullptr;
};
struct CloudValue {
  std::string name;
  int floats = 1;
  float* c[3] = {nullptr, nullptr, nullptr};
};

/// What of a point cloud is in the way of a hemisphere.
struct DisksQuery {
  std::string channel;          ///< What the disks send.
  float maxSolidAngle = 0.01f;  ///< Disks that together are seen under less count as one.
  bool clamp = true;            ///< Those behind others do not count.
  float coneAngle = kPi / 2;    ///< Half angle of what is looked at.
  OcclusionQuery falloff;
};

/// The seam to point clouds and brick maps (implemented in gi/clouds, injected by reyes/app). `problem` says why false
/// is returned.
class CloudServices {
 public:
  virtual ~CloudServices() = default;
  virtual bool bake(const CloudQuery&, const std::vector<CloudValue>&, std::string& problem) = 0;
  virtual bool lookUp(const CloudQuery&, const std::vector<CloudValue>&, float* found, std::string& problem) = 0;
  /// E/pi of a photon map.
  virtual bool photons(const CloudQuery&, const TmPhotonOptions&, TmVec3 E, std::string& problem) = 0;
  /// Share of the hemisphere around N, weighted by the cosine, and (unless x is null) the mean radiance that arrives
  /// from it.
  virtual bool occlusion(const CloudQuery&, const DisksQuery&, float* covered, TmVec3 radiance,
                         std::string& problem) = 0;
  /// Baked light that leaves after diffusion, E/pi.
  virtual bool subsurface(const CloudQuery&, const TmSubsurfaceOptions&, TmVec3 out, std::string& problem) = 0;
};

}  // namespace tomales

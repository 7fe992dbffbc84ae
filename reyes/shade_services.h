// How a batch of points is to be shaded, and what shading may ask of units that know more than the points: ray tracing
// and global illumination. Light is in the RSL convention, E/pi; colours along rays are radiance. Space: current.
// Results of points that are not active are left alone. Threads: const members may be called concurrently.
#pragma once
#include <optional>
#include <span>

#include "gi/error_function.h"
#include "gi/method.h"
#include "reyes/density.h"
#include "reyes/points.h"
#include "reyes/ray_answers.h"
#include "reyes/state.h"

namespace tomales {

enum class RayKind : uint8_t {
  Camera,  ///< Visible micropolygons run the whole shader.
  /// Hits of gather rays get direct light, the diffuse component and the highlights that the context asks for, and no
  /// emission of area lights (Tabellion and Lamorlette 2004, sections 4.1 and 4.2).
  Diffuse,
  Specular,      ///< Hits of reflected and refracted rays run the whole shader, and get the emission of area lights.
  Transmission,  ///< Surfaces that shadow rays pass through give opacity alone, without light.
};

/// The light in which a batch is shaded.
enum class Illumination : uint8_t {
  Lights,           ///< The lights of the scene.
  Stored,           ///< ShadeServices::storedIrradiance alone, as one light along the normal.
  Unit,             ///< E/pi = 1 everywhere, as one light along the normal: the result is the diffuse reflectance.
  None,             ///< No light: the result is what the surface emits.
  LightsAndStored,  ///< The sum of Lights and Stored. The stored light must then leave out light straight from lights.
};
enum class HitSides : uint8_t { Both, Front, Back };

/// A value at the hit of a ray, by its RSL gather() name, for `floats` (1 or 3) arrays of the caller.
struct RayOutput {
  std::string name;
  int floats = 1;
  float* c[3] = {nullptr, nullptr, nullptr};
};

/// The highlights that diffuse rays bring from the surfaces that they hit.
enum class HitHighlights : uint8_t {
  None,
  OfSpecular,  ///< Those of specular(): no brighter than Cl, so that few rays suffice.
  All,         ///< Shaders add their own too, and follow them by rays, as with the reference path tracer.
};

/// What a batch is shaded for. Where it is not the picture, nothing is baked, printed or counted.
enum class Purpose : uint8_t {
  Picture,    ///< The picture that is kept.
  Sketch,     ///< Shaders run for a picture that is not kept.
  Rehearsal,  ///< Shaders run only to learn what they ask: no ray is traced.
};

/// What an audit asks of the highlights of indirect light, where the eye looks.
enum class LobeAudit {
  Off,
  Even,  ///< They reflect a radiance of 1 from everywhere, which shows where there are any.
  Paths  ///< ShadeContext::auditPaths paths go along each lobe.
};

/// The purpose of shading a batch, and its settings.
struct ShadeContext {
  RayKind kind = RayKind::Camera;
  int diffuseDepth = 0;  ///< Diffuse bounces between the eye and these points.
  uint32_t seed = 0;
  int lightSamples = 0;  ///< Samples of each area light and of the sky; 0 for the number that the light asks for.
  bool indirect = true;  ///< Indirect lights run.
  bool direct = true;    ///< The other lights run where the eye looks. At hits of rays they run in any case.
  /// If not null, of all lights but indirect ones only those of this LightGroup shine, everywhere; empty for none of
  /// them.
  const std::string* onlyLightGroup = nullptr;
  bool variables = false;  ///< The variables that outputOf(options) lists are stored.
  /// Store these instead: for "surface:NAME" the outputs of the shader, or NaN if it has none of this name.
  const std::vector<RayOutput>* outputs = nullptr;
  Illumination illumination = Illumination::Lights;
  int specularDepth = 0;  ///< Specular bounces between the eye and these points.
  int diffuseLimit = 1 << 20,
      specularLimit = 1 << 20;  ///< Depths beyond which no ray follows, set by the objects on the way.
  std::string label{};          ///< The label of the ray that came here.
  bool seesAreaLights = true;   ///< True if that ray sees area lights.
  /// Specular rays bring the light of lamps and skies. False where photons have brought that light by way of mirrors.
  bool specularRaysSeeLights = true;
  /// Indexed by group: 1 if photons have brought the caustics of the group's mirrors and glass. specularRaysSeeLights
  /// then counts as false for specular rays from the group and for its highlights. Null: no group has such photons.
  const std::vector<uint8_t>* groupsWithCaustics = nullptr;
  HitHighlights highlights = HitHighlights::None;
  /// Answers of this batch, asked before shadow and gather rays are traced. Null: all rays are traced.
  RayAnswers* answers = nullptr;
  Purpose purpose = Purpose::Picture;
  float importance = 1;  ///< The weight of what is seen here in the eye's picture.
  /// Number of paths that find indirect light at each point without records or maps, to measure the error of those. 0:
  /// the frame's method finds that light.
  int auditPaths = 0;
  LobeAudit lobes = LobeAudit::Off;
  /// Records are changed by an independent draw of their noise (GiServices::redrawRecords). With another seed this
  /// gives an independent picture of the frame, from which its standard error is known.
  bool redrawn = false;
  /// The number of specular rays that one point of the eye has sent. The points that they meet share the weight of that
  /// point.
  int branches = 1;
  /// The Volume that each point's ray crosses (ShadingSystem::crossVolume). Empty: the air is the same everywhere.
  std::span<const DensityAlongRay> densities{};
  int subBatch = 0;  ///< The part of the batch that is being shaded, set by ShadingSystem.

  /// Tells whether lamps have highlights on surfaces of a group.
  bool hasHighlights(int group) const {
    return (kind != RayKind::Diffuse || highlights != HitHighlights::None) &&
           !(groupsWithCaustics && (*groupsWithCaustics)[static_cast<size_t>(group)]);
  }
  /// Tells whether lamps and skies are seen in mirrors and glass of a group.
  bool seesLightsInMirrors(int group) const {
    return specularRaysSeeLights && !(groupsWithCaustics && (*groupsWithCaustics)[static_cast<size_t>(group)]);
  }
};

/// Returns the number of samples or rays that bring light to a point. A point that the eye sees gets `count`. Points on
/// the branches of one path share that number, so that together they have as much noise as one point. Each gets `least`
/// or more, unless `count` is less.
inline int shareOfBranch(int count, int least, const ShadeContext& context) {
  return std::max(std::min(count, least), count / context.branches);
}
/// Returns the same for rays that a shader asks for. A point that gather rays meet gets no more than `least`, because
/// it is one of the hundreds that make one record.
inline int raysOfBranch(int count, int least, const ShadeContext& context) {
  return context.diffuseDepth > 0 ? std::min(count, least) : shareOfBranch(count, least, context);
}

/// Least number of rays of a hemisphere. A shader may use the result in a way that is not linear.
constexpr int kLeastOfHemisphere = 16;

/// The options of one set of rays of a shader's call.
struct RayQuery {
  RayKind kind = RayKind::Specular;
  float maxDistance = kRiInfinity;
  float bias = -1;  ///< Bias of the rays; negative if the object's attributes give it.
  std::string label, subset, excludeSubset;
  HitSides sides = HitSides::Both;
  std::optional<HitMode> mode;  ///< Empty if the attributes of the object that is met say it.
  float opacityThreshold = 1;   ///< A ray goes on behind transparent things until this much is covered.
  int number = 0, count = 1;    ///< This is ray `number` of `count` from each point.
  bool seesAreaLights = true;   ///< The rays see area lights.
  float importance = 1;         ///< The weight of the light that these rays bring.
  /// The radius of each ray's footprint at its start, and its growth for each unit of length. Null if rays have no
  /// width.
  const float *radius = nullptr, *spread = nullptr;
};

/// Arrays for count() points; null pointers for what is not wanted.
struct RayResult {
  float* distance = nullptr;       ///< kInfinity if nothing was met; no output is set then.
  TmVec3 color{}, opacity{};       ///< The sum over all surfaces that the ray went through.
  float* effective = nullptr;      ///< The mean distance of the surfaces that cover it; kInfinity if nothing does.
  uint8_t* leaves = nullptr;       ///< 1 if the ray was traced and leaves the scene, even through transparent things.
  std::vector<RayOutput> outputs;  ///< The outputs of the first hit.
};

/// The parameters of an indirect light where it lights (docs/gi.md).
struct IndirectQuery {
  int samples = 600;
  float maxError = 1, maxDistance = kRiInfinity;
  ErrorFunction errorFunction = ErrorFunction::Screen;
  std::string subset;
  int bounces = 1;
};

/// The parameters of indirect lights that concern a frame as a whole.
struct IndirectRequest {
  const GiMethod* method = giMethodOfRadiance("shader");
  std::string atlas;           ///< The folder of the maps that gather rays look up; empty if none is named.
  std::optional<int> bounces;  ///< The diffuse bounces of photons, if the scene gives them.
};

/// The air of a volume shader as photons meet it. Values are for each unit of length of the world, by colour.
struct MediumColors {
  vec3 scattering{0.0f}, absorption{0.0f};
};

/// The HemisphereQuery::maxVariation that allows as much as a maxerror of 1.
constexpr float kVariationOfError = 0.05f;

/// What occlusion() or indirectdiffuse() asks of a hemisphere, weighted by the cosine. Answers may be interpolated.
struct HemisphereQuery {
  int samples = 1;
  float maxDistance = kRiInfinity, bias = -1;
  float falloff = 0;
  int falloffMode = 0;
  float maxVariation = 0;       ///< Greatest error of the answers: absolute for coverage, relative for radiance.
  bool radiance = false;        ///< Asks for the mean radiance from the hemisphere, not for the share that is covered.
  std::optional<HitMode> mode;  ///< As RayQuery::mode; for radiance alone.
  int diffuseLimit = 0;         ///< For radiance alone: greatest depth at which shaders of hits ask for it in turn.
  std::string subset, excludeSubset;
  HitSides sides = HitSides::Both;
  bool operator==(const HemisphereQuery&) const = default;

  /// Returns how much of a ray is covered by a hit at that distance.
  float coveredAt(float distance) const {
    if (!(distance < kRiInfinity)) return 0;
    if (falloff <= 0) return 1;
    return falloffMode == 1 ? std::pow(std::max(0.0f, 1 - distance / maxDistance), falloff)
                            : std::exp(-falloff * distance);
  }
};

/// Arrays for count() points. E is E/pi.
struct IndirectResult {
  TmVec3 E;
  TmVec3 dominant[3];  ///< Unit vectors for red, green and blue. Null pointers if they are not wanted.
};

/// Points of area lights, as other points see them. All arrays have one length.
struct EmitterPoints {
  TmVec3 P, N;     ///< N has unit length, on the RISpec side.
  float* pdf;      ///< The probability density of samples there, over solid angle; 0 if nothing shines from there.
  float* meetPdf;  ///< The same, but 0 where meetEmitter() does not find the point.
};

/// The shadow rays of a light: sample `sample` of `samples`, towards a point or (solar) to infinity.
struct ShadowRays {
  bool solar = false;
  int sample = 0, samples = 1;
  const RayQuery* query = nullptr;  ///< The query of transmission() in a shader; null for lights.
  int through = -1;                 ///< The geometry of this area light lets the rays pass. -1: no geometry does.
};

/// One of several directions that points draw from their lobes: unit vectors.
struct LobeDirection {
  TmConstVec3 L;
  int number = 0, count = 1;
};

/// The interface to ray tracing and global illumination. gi/services.h implements it, and reyes/app hands it to
/// shading. Arrays have an element for each point; `active` has a 0 for points that are to be left alone.
class ShadeServices {
 public:
  virtual ~ShadeServices() = default;

  /// Multiplies `light` by the share that arrives at each point from P + toward (solar: from infinity along it). Where
  /// things move, it is the mean over the times at which the points are seen.
  virtual void transmission(const ShadePoints& points, const uint8_t* active, TmConstVec3 toward,
                            const ShadowRays& rays, const ShadeContext& context, TmVec3 light) const = 0;

  /// Tells whether trace() traces anything for this query: false past the limit of the depth of rays.
  virtual bool tracesFrom(const ShadePoints&, const RayQuery&, const ShadeContext&) const { return true; }
  /// Traces one ray from P along the unit `direction` for each active point, if tracesFrom() says so.
  virtual void trace(const ShadePoints& points, const uint8_t* active, TmConstVec3 P, TmConstVec3 direction,
                     const RayQuery& query, const ShadeContext& context, const RayResult& result) const = 0;

  /// Takes a point on area light `light` for each xi in [0,1)^2, as seen from `from`. Returns false if the light has no
  /// geometry.
  virtual bool sampleEmitter(int light, int count, TmConstVec3 from, const float* xi0, const float* xi1,
                             const EmitterPoints& out) const = 0;
  /// Takes points all over area light `light`, evenly by area, on the sides that are seen and on others. `out.pdf` is
  /// such that a mean weighted by 1 / (pi pdf) is the mean over the area. meetPdf is a density over solid angle, as
  /// seen from `from`, where meetWholeEmitter() finds the point. Returns false if the light has no geometry.
  virtual bool sampleWholeEmitter(int light, int count, TmConstVec3 from, const float* xi0, const float* xi1,
                                  const EmitterPoints& out) const;
  /// Finds the nearest point that shines along each unit direction, on the light's emitters of simple shapes. Where
  /// nothing is met it writes a pdf of 0, and the rest of `out` is not defined.
  virtual void meetEmitter(int light, int count, TmConstVec3 from, TmConstVec3 direction,
                           const EmitterPoints& out) const = 0;

  /// Does the same for one of the points in which a direction crosses the geometry, from any side. `layer` counts them
  /// from the nearest.
  virtual void meetWholeEmitter(int light, int layer, int count, TmConstVec3 from, TmConstVec3 direction,
                                const EmitterPoints& out) const;

  /// Interpolates what a query asks of the hemisphere around N. That is its mean radiance (E/pi), or the share that is
  /// covered, repeated in all three colours. Returns false, and leaves `out` alone, if nothing is known and rays must
  /// tell.
  virtual bool interpolatedHemisphere(const ShadePoints& points, const uint8_t* active, TmConstVec3 N,
                                      const HemisphereQuery& query, const ShadeContext& context, TmVec3 out) const;

  /// Gives the E/pi that an earlier pass stored around each point, or zero where there is none. kArea of the points is
  /// the area to average over.
  virtual void storedIrradiance(const ShadePoints& points, const uint8_t* active, TmVec3 E) const;
  /// Returns how far in front of an area light's samples the polygons may lie that rays meet in its place. Shadow rays
  /// end before that.
  virtual float emitterReach(int light) const = 0;
  /// Returns the area of all geometry of an area light; 0 if it has none.
  virtual float emitterArea(int light) const = 0;
  /// Returns the box around all geometry of an area light; empty if it has none.
  virtual Bound3 emitterBound(int light) const;

  /// Writes the light that Volumes scatter between the eye and the points that it sees, from P - I to P, and the share
  /// of light that they absorb or scatter away. Returns false if there is no Volume.
  virtual bool volumesBefore(const ShadePoints& points, const ShadeContext& context, ShadedPoints& out) const;

  /// Gives the indirect diffuse light on the side of N.
  virtual void indirectDiffuse(const ShadePoints& points, const uint8_t* active, TmConstVec3 N,
                               const IndirectQuery& query, const ShadeContext& context, IndirectResult out) const = 0;

  /// Tells whether indirectAlong() knows an answer: paths find the indirect light of highlights.
  virtual bool followsLobes(const ShadeContext&) const { return false; }
  /// Gives the radiance that other surfaces send to each point along a unit direction, `way.number` of `way.count`.
  virtual void indirectAlong(const ShadePoints& points, const uint8_t* active, const LobeDirection& way,
                             const IndirectQuery& query, const ShadeContext& context, TmVec3 out) const;
};

}  // namespace tomales

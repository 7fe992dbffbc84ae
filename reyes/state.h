// Noun: the state that RIB requests leave, frozen at WorldEnd: options, camera, attributes, shader calls, motion.
// Defaults are those of RISpec 3.2 unless a comment says otherwise.
// Threads: built by one thread (reyes/rib), read by many.
#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "reyes/base/log.h"
#include "reyes/base/math.h"
#include "reyes/base/value.h"
#include "reyes/light_list.h"

namespace tomales {

/// A transformation that may move: keys at increasing times, constant outside. Between keys a rotation follows its arc
/// (the shorter one), and position, scale and shear are linear. If a mirror or a projection lies between two keys, the
/// matrix is linear.
struct Motion {
  /// 10 degrees: a chord then leaves its circle by 0.4 % of the radius.
  static constexpr float kLargestTurn = 0.17453293f;

  std::vector<float> times{0.0f};
  std::vector<mat4> keys{mat4(1.0f)};

  bool operator==(const Motion&) const = default;
  bool moving() const { return keys.size() > 1; }
  mat4 at(float time) const;
  /// Adds keys, so that no key is turned by more than kLargestTurn from the one before: products and grid vertices made
  /// from them move in straight lines between keys.
  Motion refined() const;
  static Motion still(const mat4& m) { return {{0.0f}, {m}}; }
};
/// a(t) * b(t), with a key at every key time of either, refined.
Motion operator*(const Motion& a, const Motion& b);

/// One Surface, Displacement, LightSource, ... request.
struct ShaderCall {
  std::string name;
  ParamList params;
  Motion worldFromShader;  ///< The CTM at the request: points among the parameters are given in that space.
  SourceLoc where;

  /// Equal calls shade alike. The folder of the file in which they are written is a part of that, as a shader may lie
  /// beside it.
  bool operator==(const ShaderCall& o) const {
    return name == o.name && params == o.params && worldFromShader == o.worldFromShader &&
           (where.file == o.where.file || where.folder() == o.where.folder());
  }
};

struct LightCall {
  ShaderCall shader;
  std::string handle;
  bool area = false;          ///< AreaLightSource: its emitters are the Objects whose attributes name it.
  bool castsShadows = false;  ///< Attribute "light" "shadows" "on"; area lights always do. Its shader may ask for more.
  int index = -1;             ///< Index in Scene::lights.
};

struct DisplayCall {
  /// mode: "rgb", "rgbaz", "z", or names: "Ci,a,z,diffuse".
  std::string name = "ri.pic", type = "file", mode = "rgba";
  ParamList params;
  SourceLoc where;
};

/// DisplayChannel: a variable that Displays may name.
struct ChannelCall {
  std::string name;
  ValueType type = ValueType::Color;
  ParamList params;
  SourceLoc where;
};

/// The way in which a pixel's depth is made from its samples that see something opaque: the least, the greatest or the
/// mean depth. Midpoint takes the mean depth of each sample's two nearest surfaces, and of these means the least (Woo
/// 1992); the far clipping plane stands for a missing second surface.
enum class DepthFilter { Min, Max, Average, Midpoint };

enum class ProjectionKind { Orthographic, Perspective, Null };

/// Hider "aperture": a regular polygon inscribed in the lens, or a disk if it has fewer than three sides.
struct Aperture {
  float sides = 0, angle_degrees = 0;  ///< Counterclockwise in the picture; at 0 a corner points right.
  float roundness = 0;                 ///< At 1 its sides are arcs of the lens's rim; at -1 they bend inwards as much.
  float density = 0;                   ///< At 1 it is dark in the middle, at -1 at the rim, linearly in between.
};

/// Options or attributes that shaders may read, by "category:name".
using UserParams = std::map<std::string, Param>;
/// Makes a parameter that is one string.
inline Param wordParam(std::string name, std::string value) {
  Param out;
  out.name = std::move(name);
  out.type = ValueType::String;
  out.strings.push_back(std::move(value));
  return out;
}
/// Returns the option or attribute of that name; null if there is none.
inline const Param* findParam(const UserParams& user, const std::string& name) {
  const auto it = user.find(name);
  return it == user.end() ? nullptr : &it->second;
}
inline std::string wordOf(const UserParams& user, const std::string& name) { return wordOf(findParam(user, name)); }

struct Quantize {
  float one = 255, min = 0, max = 255, dither = 0.5f, zero = 0;
};

struct Options {
  int xResolution = 640, yResolution = 480;
  float pixelAspect = 1;
  std::optional<float> frameAspect;
  std::optional<std::array<float, 4>> screenWindow;  ///< left right bottom top
  std::array<float, 4> cropWindow{0, 1, 0, 1};       ///< xmin xmax ymin ymax of the frame, from the top left
  ProjectionKind projection = ProjectionKind::Orthographic;
  float fov_degrees = 90;
  float nearClip = 1e-6f, farClip = kRiInfinity;
  float shutterOpen = 0, shutterClose = 0;
  float shutterOffset = 0;   ///< Added to the times of motion blocks as they are read.
  bool sampleMotion = true;  ///< Hider "samplemotion": the camera sees motion.
  float fStop = kInfinity, focalLength = 1, focalDistance = 1;
  Aperture aperture;
  float dofAspect = 1;  ///< Width over height of the circle of confusion.
  int xSamples = 2, ySamples = 2;
  std::string filter = "gaussian";
  float xFilterWidth = 2, yFilterWidth = 2;
  float exposureGain = 1, exposureGamma = 1;
  Quantize rgbaQuantize{}, depthQuantize{0, 0, 0, 0};
  bool quantizeGiven = false;                   ///< The RIB has a Quantize request; else the file's type decides.
  std::vector<DisplayCall> displays;            ///< If it is empty, there is the default Display.
  std::map<std::string, ChannelCall> channels;  ///< Indexed by name.
  DepthFilter depthFilter = DepthFilter::Min;
  vec3 opaqueThreshold{0.996f};  ///< Limits "othreshold": a surface of this opacity hides everything behind it.
  vec3 depthThreshold{1.0f};     ///< Limits "zthreshold": less opaque surfaces have no depth.
  std::optional<ShaderCall> imager;
  int bucketWidth = 32, bucketHeight = 32;
  std::string bucketOrder = "horizontal";  ///< Option "bucket" "order": reyes/frame/bucket_order.h
  int maxRayDepth = 10;                    ///< Bounces of any kind.
  int gridSize = 256;                      ///< Greatest number of micropolygons in a grid.
  std::string hider = "hidden";
  bool jitter = true;
  float relativeDetail = 1;          ///< Factor on every measured level of detail.
  std::vector<vec4> clippingPlanes;  ///< Planes in camera space: a point p with dot(plane, (p, 1)) > 0 is not seen.
  bool wantsIndirect = false;        ///< --gi: a scene without an indirect light gets one, for all objects.
  int indirectSamples = 0;           ///< --draft: rays of an irradiance record; 0: as indirect lights ask.
  int frame = 0;
  std::map<std::string, std::string> searchPaths;  ///< "archive", "texture", "shader", "display", ...
  UserParams user;

  /// Tells whether the shutter is open for some time, and motion wanted. Otherwise nothing is blurred.
  bool shutterIsOpen() const { return sampleMotion && shutterClose > shutterOpen; }
};

enum class ShadingInterpolation { Constant, Smooth };

/// The source of a hit's colour and opacity for a ray: its shader, or the primitive's attributes alone.
enum class HitMode : uint8_t { Shader, Primitive };

struct Visibility {
  bool camera = true, diffuse = true, specular = true, transmission = true, photon = true;
  bool operator==(const Visibility&) const = default;
};

/// The part of 0..1 in which an object exists: each sample and each ray has a number in 0..1, so that levels of detail
/// that fade into each other divide them without overlap.
struct DetailShare {
  float lo = 0, hi = 1;
  bool operator==(const DetailShare&) const = default;
  bool whole() const { return lo <= 0 && hi >= 1; }
  bool empty() const { return !(lo < hi); }
  bool contains(float x) const { return x >= lo && x < hi; }
};

/// The polygons of a surface that rays see: those of one rate; of three rates, by the width of the ray; or
/// micropolygons.
enum class TessellationMode : uint8_t { Fixed, Multiresolution, Full };

/// Immutable once a primitive refers to it; consecutive primitives share one.
struct Attributes {
  vec3 color{1.0f}, opacity{1.0f};
  std::array<vec2, 4> textureCoordinates{vec2{0, 0}, vec2{1, 0}, vec2{0, 1}, vec2{1, 1}};
  float shadingRate = 1;                    ///< px2 for one micropolygon
  float motionFactor = 0, focusFactor = 1;  ///< GeometricApproximation: coarser where blurred; 0: never
  ShadingInterpolation interpolation = ShadingInterpolation::Constant;
  bool matte = false;
  bool volume = false;  ///< It is a Volume: its surface is the box that holds it, and Interior says what fills it.
  int sides = 2;
  DetailShare detail;                ///< Detail and DetailRange
  bool insideOut = false;            ///< Orientation differs from "outside".
  std::string name;                  ///< Attribute "identifier" "name"
  std::set<std::string> membership;  ///< Attribute "grouping" "membership": the sets it is in
  HitMode diffuseHitMode = HitMode::Shader, specularHitMode = HitMode::Shader, transmissionHitMode = HitMode::Shader;
  std::shared_ptr<const ShaderCall> surface, displacement, atmosphere;  ///< null for the default surface, or none
  std::shared_ptr<const ShaderCall> interior,
      exterior;        ///< Volume shaders of the space that rays cross after leaving the surface inwards and outwards.
  LightList lights;    ///< Indices in Scene::lights of lights that are switched on.
  int areaLight = -1;  ///< Index of the light that this geometry emits for; -1 if there is none.
  float displacementBound = 0;  ///< Radius in the space below.
  std::string displacementBoundSpace = "object";
  /// Names and types of what the displacement shader computes for surfaces. Vertices have room for it.
  std::vector<Param> displacementOutputs;
  Visibility visibility;
  struct Trace {
    std::optional<float> bias, offset;
    bool displacements = false;       ///< Rays see its displacement.
    bool displacementsGiven = false;  ///< The scene says so or not; else raytrace/visible_displacement.h chooses.
    /// The factor by which raytrace/visible_displacement.h has multiplied the tessellation; 0: it has not chosen.
    float chosenFiner = 0;
    bool sampleMotion = true;  ///< Rays from this object see motion.
    int maxDiffuseDepth = 1,
        maxSpecularDepth = 2;  ///< Bounces that may follow one at this object; an earlier object's limit still applies.
    std::string subset;        ///< Attribute "grouping" "tracesubset": what rays from here see; if empty, they see all
    /// Returns the sets that a ray from here sees if the ray itself asks for the sets `asked`.
    const std::string& subsetFor(const std::string& asked) const { return asked.empty() ? subset : asked; }
    float tessellation = 1;
    TessellationMode rate = TessellationMode::Fixed;
    bool operator==(const Trace&) const = default;
  } trace;
  struct Indirect {
    bool receive = true;
    float gain = 1, bleeding = 1;
    vec3 bleedingColor{1.0f};
    std::string surface;
    bool operator==(const Indirect&) const = default;
  } indirect;
  struct Photon {
    std::string globalMap;   ///< Name of the map that this geometry shares; if it is empty, one is chosen.
    std::string causticMap;  ///< Name of the map of photons that come by mirrors and glass; if empty, none are kept.
    std::string shadingModel = "matte";
    bool operator==(const Photon&) const = default;
  } photon;
  struct Radiosity {      ///< The radiosity map of the object (docs/gi.md).
    bool screen = true;   ///< True if texelSize is in pixels, false if it is in units of the world.
    float texelSize = 4;  ///< 0 if it has no map.
    bool operator==(const Radiosity&) const = default;
  } radiosity;
  std::optional<float> irradianceMaxError, irradianceMaxPixelDist;
  bool rasterOrient = true;  ///< Attribute "dice" "rasterorient"
  /// Attribute "cull": true if micropolygons are left out that the camera does not see, because something hides them or
  /// because they are one-sided and face away. Else shaders run there too, for what they bake.
  struct Cull {
    bool hidden = true, backfacing = true;
    bool operator==(const Cull&) const = default;
  } cull;
  bool binaryDice = false;  ///< Attribute "dice" "binary": counts are powers of two.
  UserParams user;

  bool operator==(const Attributes&) const = default;  ///< Compares shaders by pointer.

  /// Returns the texture coordinates at surface parameters (u, v), for primitives that have no primitive variables s
  /// and t.
  vec2 textureAt(float u, float v) const {
    const auto& c = textureCoordinates;
    return glm::mix(glm::mix(c[0], c[1], u), glm::mix(c[2], c[3], u), v);
  }
};

}  // namespace tomales

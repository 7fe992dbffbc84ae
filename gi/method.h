// The methods of indirect light, as the command line (--gi) and indirect lights ("radiance") name them. The rows for
// them in reyes/app/frame/light_sources.cpp make what a method needs besides rays.
#pragma once
#include <string>
#include <string_view>

namespace tomales {

enum class GiMode {
  None,       ///< Direct light only: indirect lights give nothing.
  Gather,     ///< Hits are shaded, further bounces have caches of their own; irradiance caching.
  Atlas,      ///< All bounces: gather rays look up the irradiance of photons in brick maps; irradiance caching.
  Radiosity,  ///< One bounce from baked direct light, in textures or brick maps; irradiance caching.
  Baked,      ///< All light from brick maps that were gathered for earlier frames (Christensen and Batali 2004,
              ///< section 6.3): no rays.
  /// Brute-force path tracing of the same transport: unbiased for diffuse surfaces. Photons bring caustics.
  Reference,
  Progressive,  ///< All bounces: photons are counted where the eye looks, on disks that shrink.
};

struct GiMethod {
  const char* name;                ///< The name for --gi.
  GiMode mode;                     ///< The mode that carries it out.
  const char* radiance = nullptr;  ///< The "radiance" by which an indirect light asks for it; null: no light can.
  bool caches = false;             ///< Light is gathered in irradiance records before the frame is shaded.
  bool hitsHoldAll = false;        ///< Hits look up all light that the method follows: no further bounces.
  bool makesMaps = false;          ///< It makes maps of all objects first, which takes memory.
  bool byPointClouds = false;      ///< The maps come from the point clouds of --atlas.
  bool usesBaked = false;          ///< Light comes from the maps of --baked.
  bool fullGeometry = false;       ///< Rays see micropolygons unless --ray-geometry says otherwise.
  bool isReference = false;        ///< Direct light has as many samples as there are paths.
  bool countsPhotons = false;      ///< Photons are counted at visible points before the frame is shaded.
  /// It counts only photons that come by mirrors and glass, and none in a scene without them.
  bool causticsAlone = false;
};

inline constexpr GiMethod kGiMethods[] = {
    {.name = "none", .mode = GiMode::None},
    {.name = "gather", .mode = GiMode::Gather, .radiance = "shader", .caches = true},
    {.name = "atlas",
     .mode = GiMode::Atlas,
     .radiance = "atlas",
     .caches = true,
     .hitsHoldAll = true,
     .makesMaps = true},
    {.name = "points",
     .mode = GiMode::Atlas,
     .radiance = "points",
     .caches = true,
     .hitsHoldAll = true,
     .makesMaps = true,
     .byPointClouds = true},
    {.name = "radiosity", .mode = GiMode::Radiosity, .radiance = "radiosity", .caches = true, .hitsHoldAll = true},
    {.name = "baked", .mode = GiMode::Baked, .usesBaked = true},
    {.name = "progressive",
     .mode = GiMode::Progressive,
     .radiance = "progressive",
     .fullGeometry = true,
     .countsPhotons = true},
    {.name = "reference",
     .mode = GiMode::Reference,
     .fullGeometry = true,
     .isReference = true,
     .countsPhotons = true,
     .causticsAlone = true},
};

/// Returns null if there is no such method.
constexpr const GiMethod* giMethodNamed(std::string_view name) {
  for (const GiMethod& m : kGiMethods)
    if (name == m.name) return &m;
  return nullptr;
}
constexpr const GiMethod* giMethodOfRadiance(std::string_view radiance) {
  for (const GiMethod& m : kGiMethods)
    if (m.radiance && radiance == m.radiance) return &m;
  return nullptr;
}
/// Returns the first method of this mode.
constexpr const GiMethod& giMethodOf(GiMode mode) {
  const GiMethod* m = kGiMethods;
  while (m->mode != mode) ++m;
  return *m;
}

/// Returns the names for help texts: "none, gather".
inline std::string giMethodNames(const char* between = ", ") {
  std::string out;
  for (const GiMethod& m : kGiMethods) out += (out.empty() ? "" : between) + std::string(m.name);
  return out;
}

}  // namespace tomales

// Noun: radiosity maps (Tabellion and Lamorlette 2004, section 4.4), a texture for each surface with its radiance by
// direct light, so that gather rays run no shader. Every patch has a chart of its own, a power of two wide and high, so
// that MIP levels never mix patches; its parameters are the patch's (u, v), which every surface has. A surface that
// shows both sides has charts for both. Hits on surfaces without maps are shaded: points and curves that turn to the
// eye, parts of solids, transparent objects, shaders that trace rays, and surfaces that displacement moves for rays.
// Values are radiance as hits of gather rays have it, the same towards all directions. Threads: const members may be
// called concurrently.
#pragma once
#include <functional>

#include "gi/hit_radiance.h"
#include "reyes/base/checkpoint.h"
#include "reyes/camera.h"

namespace tomales {

struct RadiositySettings {
  float texels = 1;  ///< Factor on the texels along each edge that Attribute "radiosity" asks for.
  uint32_t seed = 0;
  /// Limit for all maps together, about 20 bytes a texel. All maps are halved until they keep this limit. It is lower
  /// for small pictures (layout.cpp).
  int64_t mostTexels = int64_t{1} << 25;
  std::function<void(float)> progress{};  ///< Is told how far baking is, by any thread.
  Checkpoint* kept = nullptr;             ///< Keeps what is baked for a later run. Null: nothing does.
};

/// Texels of one side of a patch, row by row, v down, and all coarser levels after them.
struct RadiosityChart {
  /// Size of the finest level, powers of two; each level halves the edges that are not 1 yet.
  int width = 0, height = 0;
  float texelSize = 0;  ///< Root of the mean area of a texel of the finest level, in current space.
  std::vector<vec3> texels;
  /// Share of each texel of the finest level that is known, until makeLevels(); empty: all of each.
  std::vector<float> coverage;

  /// Returns the number of texels of the finest level.
  size_t texelCount() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
  int levels() const;
  /// Pre: no texels yet.
  void halve();
  void allocate();
  /// Makes the coarser levels from level 0, weighted by the known share of each texel, and fills unknown texels from
  /// the coarser levels.
  void makeLevels();
  /// Looks up radiance: bilinear inside the chart, linear between levels. `footprint`: the width of the ray's
  /// footprint, in current space.
  vec3 lookup(float u, float v, float footprint) const;

 private:
  vec3 atLevel(int level, float u, float v) const;
};

struct SurfaceCharts;  ///< gi/radiosity/layout.h

class RadiosityMaps final : public HitRadiance {
 public:
  /// Bakes a map for every object that gather rays meet. Reports in the log which have none, and why.
  RadiosityMaps(const RayScene& rays, const ShadingSystem& shading, const Camera& camera,
                const RadiositySettings& settings, Log& log);

  ~RadiosityMaps() override;

  bool lookup(const Ray& ray, const Hit& hit, vec3& radiance) const override;
  /// Charts of an object by patch; empty: it has no map on this side.
  const std::vector<RadiosityChart>& charts(int object, bool back) const;
  int64_t texelCount() const;  ///< Texels of the finest levels.

 private:
  std::vector<SurfaceCharts> surfaces_;  ///< Charts by object.
};

}  // namespace tomales

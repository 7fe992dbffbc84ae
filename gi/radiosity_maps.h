// Noun: radiosity maps (approximate-gi 4.4), a texture for each surface with what it sends back of direct light, so
// that gather rays run no shader. Every patch has a chart of its own, a power of two wide and high, so that MIP levels
// never mix patches; the texture mapping that is inverted is that of the patch, (u, v), which every surface has. Both
// sides of a surface that shows both. What has no map is shaded where it is hit: points and curves that turn to the
// eye, what is not opaque, what traces rays itself, and what displacement moves for rays. Irradiance: none; radiance
// towards all sides, as a hit is shaded for gather rays. Threads: const members may be called concurrently.
#pragma once
#include "gi/hit_radiance.h"
#include "reyes/camera.h"

namespace tomales {

struct RadiositySettings {
  float texels = 1;  ///< Times as many along each edge as Attribute "radiosity" asks.
  uint32_t seed = 0;
  int64_t mostTexels =
      int64_t{1} << 25;  ///< Of all maps together, which are halved until they have no more: about 20 bytes each.
};

/// Texels of one side of a patch, row by row, v down, and all coarser levels after them.
struct RadiosityChart {
  int width = 0, height = 0;  ///< Of the finest level, powers of two; each level halves what is not 1 yet.
  float texelSize = 0;        ///< Of it: root of its mean area.
  std::vector<vec3> texels;
  std::vector<float> coverage;  ///< Of each texel of the finest level, until makeLevels(): share of it that is known;
                                ///< empty: all of each.

  size_t texelCount() const {
    return static_cast<size_t>(width) * static_cast<size_t>(height);
  }  ///< Of the finest level.
  int levels() const;
  /// Pre: no texels yet.
  void halve();
  void allocate();
  /// Of level 0: smooths from level to level by what is known of each texel, and fills those of which nothing is from
  /// the coarser ones.
  void makeLevels();
  /// Bilinear inside the chart, linear between levels; `width` is that of the footprint.
  vec3 lookup(float u, float v, float width) const;

 private:
  vec3 atLevel(int level, float u, float v) const;
};

struct SurfaceCharts;  ///< gi/radiosity_layout.h

class RadiosityMaps final : public HitRadiance {
 public:
  /// Bakes a map for every object that gather rays meet. Says in the log which have none, and why.
  RadiosityMaps(const RayScene& rays, const ShadingSystem& shading, const Camera& camera,
                const RadiositySettings& settings, Log& log);

  ~RadiosityMaps() override;

  bool lookup(const Ray& ray, const Hit& hit, vec3& radiance) const override;
  /// Of an object, by patch; empty: it has no such map.
  const std::vector<RadiosityChart>& charts(int object, bool back) const;
  int64_t texelCount() const;  ///< Of the finest levels.

 private:
  std::vector<SurfaceCharts> surfaces_;  ///< By object.
};

}  // namespace tomales

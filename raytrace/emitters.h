// Points on area lights. Rectangles, disks and spheres are sampled by solid angle (emitter_shapes.h). All else is by
// area: places of the true surface, chosen by the coarse quads of all objects that emit for a light in proportion to
// area, and weighted so that any surface shines as much as it does, not as its polygons would. Where rays see
// displacement the polygons stand for the surface. Directions meet the simple shapes, and meshes of few flat polygons.
// Space: current. Threads: const members may be called concurrently.
#pragma once
#include "raytrace/emitter_facets.h"
#include "raytrace/emitter_shapes.h"
#include "raytrace/tessellate.h"
#include "reyes/base/distribution.h"

namespace tomales {

/// Rows of quads that shine, and all that sampling needs of them.
struct EmitterLattice {
  uint32_t columns = 0, rows = 0;
  bool flipsNormal = false;                ///< The shining side is opposite to d/du x d/dv.
  std::vector<std::array<vec3, 4>> quads;  ///< Corners as CoarseGroup's, rows * columns.
  std::vector<vec3> normals;               ///< Unit, of the shining side.
  bool curved = false;                     ///< The quads stand for another surface.
  const CoarseGroup* surface = nullptr;  ///< Asked for every point where it is curved or trim curves cut it; else null.
  uint32_t firstQuad = 0;                ///< Number of the first quad there.
  int group = -1;                        ///< As EmitterShape::group.
};
struct EmitterLight {
  std::vector<EmitterShape> shapes;
  std::vector<EmitterLattice> lattices;
  float reach = 0;  ///< ShadeServices::emitterReach
};
/// Of every light of a scene.
using EmitterTable = std::vector<EmitterLight>;

class Emitters {
 public:
  Emitters(const Scene& scene, const std::vector<CoarseGroup>& groups);
  /// Pre: no lattice asks a surface.
  explicit Emitters(EmitterTable table);
  const EmitterTable& table() const { return table_; }

  float reach(int light) const;

  /// False: no emitter of this light has any area.
  bool shines(int light) const { return known(light) && sources(light).areas.count() > 0; }

  /// As ShadeServices::sampleEmitter. xi0 picks the emitter.
  bool sampleFrom(int light, int count, TmConstVec3 from, const float* xi0, const float* xi1,
                  const EmitterPoints& out) const;
  /// As ShadeServices::meetEmitter.
  void meet(int light, int count, TmConstVec3 from, TmConstVec3 direction, const EmitterPoints& out) const;

  /// Points of the light as a whole, wherever they are seen from. xi0 picks the lattice, xi1 its row and v, what is
  /// left of xi0 the column and u, all by area: a continuous warp of the unit square over each lattice, so that
  /// stratified points stay stratified. `area` is the Jacobian over the probability of the quad: the total area
  /// wherever quads are parallelograms. `group`: as EmitterShape::group; may be null.
  bool sample(int light, int count, const float* xi0, const float* xi1, TmVec3 P, TmVec3 N, float* area,
              int* group = nullptr) const;

 private:
  struct Source {
    uint32_t lattice;
    Distribution rows;
    std::vector<Distribution> row;  ///< quads of each row
    bool met = false;               ///< Its quads are facets.
  };
  struct Light {
    Distribution areas;           ///< Shapes come first.
    std::vector<Source> sources;  ///< Lattices with area.
    std::vector<EmitterFacet> facets;
    /// By which samples of the light and directions that meet it weigh each other: as if all polygons were sampled
    /// evenly.
    double facetDensity(const vec3& from, const vec3& P, const vec3& N) const {
      return solidAngleDensity(from, P, N, 1 / areas.total());
    }
  };
  struct AreaPoint {
    vec3 P{0}, N{0};
    double area = 0;  ///< That it stands for; 0: trimmed away
    int group = -1;
  };
  bool known(int light) const { return light >= 0 && light < static_cast<int>(lights_.size()); }
  const EmitterLight& given(int light) const { return table_[static_cast<size_t>(light)]; }
  const Light& sources(int light) const { return lights_[static_cast<size_t>(light)]; }
  static void findFacets(const EmitterLight& given, Light& light);
  /// On lattice `source`, if it were the whole light.
  AreaPoint onLattice(const EmitterLight& light, const Source& source, double u, double v) const;
  /// Position and d/du x d/dv by the quad's own parameters.
  void place(const EmitterLattice& lattice, size_t quad, float u, float v, vec3& P, vec3& normal) const;

  const Scene* scene_ = nullptr;
  EmitterTable table_;
  std::vector<Light> lights_;
};

}  // namespace tomales

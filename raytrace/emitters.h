// Points on area lights. Rectangles, disks and spheres are sampled by solid angle (emitter_shapes.h), all other
// emitters by area: their coarse quads are chosen in proportion to area, but the points lie on the true surface,
// weighted so that the light has the power of the surface and not of its polygons. Where rays see displacement, the
// polygons are the surface. Directions can meet the simple shapes, and meshes of few flat polygons. Space: current.
// Threads: const members may be called concurrently.
#pragma once
#include "raytrace/emitter_facets.h"
#include "raytrace/emitter_shapes.h"
#include "raytrace/tessellate.h"
#include "reyes/base/distribution.h"

namespace tomales {

/// A lattice of quads that shine, with the data that sampling needs.
struct EmitterLattice {
  uint32_t columns = 0, rows = 0;
  bool flipsNormal = false;                ///< The shining side is opposite to d/du x d/dv.
  std::vector<std::array<vec3, 4>> quads;  ///< Corners as in CoarseGroup, rows * columns.
  std::vector<vec3> normals;               ///< Unit normals of the shining side.
  bool curved = false;                     ///< The quads stand for a curved surface.
  /// Set where the surface is curved or trimmed, to find each point on it; else null.
  const CoarseGroup* surface = nullptr;
  uint32_t firstQuad = 0;  ///< Number of the first quad in `surface`.
  int group = -1;          ///< The same as EmitterShape::group.
};
struct EmitterLight {
  std::vector<EmitterShape> shapes;
  std::vector<EmitterLattice> lattices;
  float reach = 0;  ///< The same as ShadeServices::emitterReach.
};
/// The emitters of every light of a scene.
using EmitterTable = std::vector<EmitterLight>;

class Emitters {
 public:
  Emitters(const Scene& scene, const std::vector<CoarseGroup>& groups);
  /// Pre: no lattice has a `surface`.
  explicit Emitters(EmitterTable table);
  const EmitterTable& table() const { return table_; }

  float reach(int light) const;
  float area(int light) const;
  Bound3 bound(int light) const;

  /// Tells whether some emitter of this light has an area.
  bool shines(int light) const { return known(light) && sources(light).areas.count() > 0; }

  /// Implements ShadeServices::sampleEmitter. xi0 chooses the emitter.
  bool sampleFrom(int light, int count, TmConstVec3 from, const float* xi0, const float* xi1,
                  const EmitterPoints& out) const;
  /// Implements ShadeServices::sampleWholeEmitter.
  bool sampleWhole(int light, int count, TmConstVec3 from, const float* xi0, const float* xi1,
                   const EmitterPoints& out) const;
  /// Implements ShadeServices::meetWholeEmitter.
  void meetWhole(int light, int layer, int count, TmConstVec3 from, TmConstVec3 direction,
                 const EmitterPoints& out) const;
  /// Implements ShadeServices::meetEmitter.
  void meet(int light, int count, TmConstVec3 from, TmConstVec3 direction, const EmitterPoints& out) const;

  /// Samples points of the whole light, wherever they are seen from. xi0 chooses the lattice, xi1 its row and v, and
  /// the rest of xi0 the column and u, all by area. Over each lattice this is a continuous warp of the unit square, so
  /// that stratified points stay stratified. `area` is the Jacobian over the probability of the quad: the total area
  /// wherever quads are parallelograms. `group`: as EmitterShape::group. `met`: directions meet its emitter. Both may
  /// be null.
  bool sample(int light, int count, const float* xi0, const float* xi1, TmVec3 P, TmVec3 N, float* area,
              int* group = nullptr, uint8_t* met = nullptr) const;

 private:
  struct Source {
    uint32_t lattice;
    Distribution rows;
    std::vector<Distribution> row;  ///< Quads of each row.
    bool met = false;               ///< Its quads are among `facets`.
  };
  struct Light {
    Distribution areas;           ///< Areas of the shapes and then of the sources.
    std::vector<Source> sources;  ///< Lattices with area.
    std::vector<EmitterFacet> facets;
    /// Returns the density over solid angle by which samples of the light and directions that meet it are weighed
    /// against each other, as if all polygons were sampled uniformly by area.
    double facetPdf(const vec3& from, const vec3& P, const vec3& N) const {
      return solidAnglePdf(from, P, N, 1 / areas.total());
    }
  };
  struct AreaPoint {
    vec3 P{0}, N{0};
    double area = 0;  ///< Area that it stands for; 0: trimmed away.
    int group = -1;
  };
  bool known(int light) const { return light >= 0 && light < static_cast<int>(lights_.size()); }
  const EmitterLight& given(int light) const { return table_[static_cast<size_t>(light)]; }
  const Light& sources(int light) const { return lights_[static_cast<size_t>(light)]; }
  static void findFacets(const EmitterLight& given, Light& light);
  /// Returns a point on lattice `source`, as if it were the whole light.
  AreaPoint onLattice(const EmitterLight& light, const Source& source, double u, double v) const;
  /// Returns position and d/du x d/dv at the quad's own parameters.
  void place(const EmitterLattice& lattice, size_t quad, float u, float v, vec3& P, vec3& normal) const;

  const Scene* scene_ = nullptr;
  EmitterTable table_;
  std::vector<Light> lights_;
};

}  // namespace tomales

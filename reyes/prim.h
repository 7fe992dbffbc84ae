// Noun: geometry. A Prim is an immutable surface made of one or more *patches*, each over the unit square (u,v). To
// split a primitive means to take a smaller rectangle of one patch, so every vertex that two pieces share is evaluated
// from the same numbers.
//   bound     a box that contains a rectangle of a patch
//   evaluate  positions and derivatives at any points of a patch: for dicing a lattice and shading a ray hit alike
//   facing    turns shapes that are drawn flat towards an eye
//   kept      finds the part that trim curves keep
//   never     knows a camera, an attribute or a shader
// Space: everything is in object space. Threads: const members may be called concurrently.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reyes/base/math.h"
#include "reyes/base/value.h"

namespace tomales {

class DensityGrid;

struct UvRect {
  float u0 = 0, u1 = 1, v0 = 0, v1 = 1;
};

/// Bits for the four edges of a patch, in the order of PatchInfo::openEdges.
enum PatchEdge : uint8_t { kEdgeU0 = 1, kEdgeU1 = 2, kEdgeV0 = 4, kEdgeV1 = 8, kAllEdges = 15 };

/// Returns the values at the two ends of an edge, in the direction of u or v, from the values at the four corners of a
/// patch, which are in RISpec's order.
template <class T>
std::array<T, 2> endsOf(const std::array<T, 4>& corners, PatchEdge edge) {
  const size_t from = edge == kEdgeU1 ? 1 : edge == kEdgeV1 ? 2 : 0, to = edge == kEdgeU0 ? 2 : edge == kEdgeV0 ? 1 : 3;
  return {corners[from], corners[to]};
}

struct PatchInfo {
  bool planar = false;            ///< True if it is flat, with straight edges, so that two triangles are exact.
  uint8_t openEdges = kAllEdges;  ///< Edges that end the surface; the others have a neighbour to join without cracks.
  bool disk = false;              ///< True for a disk, whose lattice of one cell is a square of the disk's area.
};

/// The part of something that trim curves keep.
enum class Kept : uint8_t { All, Part, None };

/// The results of evaluate(): structure of arrays, each at least n long.
struct SurfacePoints {
  float *px, *py, *pz;
  float *dux, *duy, *duz;  ///< dP/du by patch parameter.
  float *dvx, *dvy, *dvz;
  /// Outward RISpec normal for Orientation "outside": dPdu x dPdv where that is defined, its limit at poles and
  /// degenerate corners. It is not normalised, and never zero for a real surface.
  float *nx, *ny, *nz;
};

/// A primitive variable as RIB gives it, values in element order.
struct Primvar {
  std::string name;
  Storage storage;
  ValueType type;
  int width;  ///< Floats of one element.
  std::vector<float> values;
};

/// Returns the offset of a variable among the floats of a point, which has those of all variables in their order; -1 if
/// none has that name.
int offsetOf(const std::vector<Primvar>& primvars, std::string_view name);
/// Returns how many floats a point has.
int floatsOfPoint(const std::vector<Primvar>& primvars);

/// A whole sphere, or a whole flat disk.
struct RoundShape {
  vec3 center;
  float radius;
  vec3 axis;  ///< Axis of a disk; zero for a sphere.
};

class Prim {
 public:
  virtual ~Prim() = default;

  virtual uint32_t patchCount() const = 0;
  virtual PatchInfo info(uint32_t patch) const = 0;

  /// Returns a box that contains every point of the rectangle, and the vertices of any lattice over a whole patch. It
  /// is conservative.
  virtual Bound3 bound(uint32_t patch, const UvRect& rect) const = 0;

  /// Fills all arrays of `out` for the n points (u[i], v[i]) of a patch.
  virtual void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const = 0;

  /// Writes the vertices of a lattice of nu x nv over a whole patch, rows along u. It is like evaluate(), except that a
  /// small round shape pushes them outward, so that its few polygons have the area of the true shape.
  virtual void evaluateLattice(uint32_t patch, int nu, int nv, const float* u, const float* v,
                               SurfacePoints out) const {
    evaluate(patch, (nu + 1) * (nv + 1), u, v, out);
  }

  /// Gives the u and v that shaders see. They run from 0 to 1 over the whole primitive, not over one patch. Those of a
  /// polygon are its x and y in object space.
  virtual void surfaceParameters(uint32_t patch, int n, const float* u, const float* v, float* su, float* sv) const;

  /// Interpolates primvars()[index]: component c of point i goes to out[c * stride + i].
  virtual void interpolate(uint32_t patch, int index, int n, const float* u, const float* v, float* out,
                           int stride) const = 0;

  /// Returns the shape as a whole, if it is a sphere or a disk.
  virtual std::optional<RoundShape> round() const { return std::nullopt; }

  /// Returns points and curves turned towards an eye that they face. With `perspective` they face the position `eye`;
  /// without it only `forward` counts, the direction in which the eye looks. Returns null if the shape looks the same
  /// to every eye.
  virtual std::shared_ptr<const Prim> facing(const vec3& /*eye*/, const vec3& /*forward*/, bool /*perspective*/) const {
    return nullptr;
  }

  /// Returns the part of a rectangle that trim curves keep. The rectangle may reach beyond the patch. Returns `Part` if
  /// in doubt.
  virtual Kept kept(uint32_t /*patch*/, const UvRect& /*rect*/) const { return Kept::All; }
  /// Tells whether trim curves keep this point.
  virtual bool keeps(uint32_t /*patch*/, float /*u*/, float /*v*/) const { return true; }

  /// Returns true for particles and ribbons, which no other surface continues: their open edges end at their vertices.
  virtual bool isLone() const { return false; }
  /// Returns the ends, in the direction of u or v, of the straight line that an edge of a patch is on, in object space.
  /// The line may go on beyond the patch: its ends are points that another surface is likely to have as well. Returns
  /// nothing if the edge is not known to be straight.
  virtual std::optional<std::array<vec3, 2>> straightEdge(uint32_t /*patch*/, PatchEdge /*edge*/) const {
    return std::nullopt;
  }

  /// Returns the density that fills the box, if the shape is a Volume.
  virtual const DensityGrid* density() const { return nullptr; }

  /// Returns the approximate memory of the primitive.
  size_t bytes() const;

  /// Returns all variables except P, in a fixed order. "st" is split into "s" and "t".
  const std::vector<Primvar>& primvars() const { return primvars_; }

 protected:
  explicit Prim(std::vector<Primvar> primvars) : primvars_(std::move(primvars)) {}
  /// Returns the memory besides the primvars.
  virtual size_t shapeBytes() const { return 0; }
  template <class T>
  static size_t bytesOf(const std::vector<T>& v) {
    return v.capacity() * sizeof(T);
  }
  std::vector<Primvar> primvars_;
};
using PrimPtr = std::shared_ptr<const Prim>;

}  // namespace tomales

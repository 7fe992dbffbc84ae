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
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "reyes/base/math.h"
#include "reyes/base/value.h"
#include "reyes/density.h"

namespace tomales {

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

// The make* functions check their input and throw PrimError with a sentence for the user; the caller adds file:line.
struct PrimError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The number of elements of a variable, by its storage class. A constant variable has one.
struct PrimvarCounts {
  size_t uniform = 1, varying = 4, vertex = 4, faceVarying = 4;
};
/// Turns a RIB parameter list into primvars. It leaves out positions (P, Pw, Pz), which the factories read themselves.
/// A variable whose number of values is not the one that `counts` asks for is dropped, with a sentence in `problems`.
std::vector<Primvar> takePrimvars(const ParamList& params, const PrimvarCounts& counts,
                                  std::vector<std::string>& problems);

// Every factory takes the parameter list after the positional arguments, and appends to `problems` what it dropped.
using Problems = std::vector<std::string>;
PrimPtr makeSphere(float radius, float zmin, float zmax, float thetaMax_degrees, const ParamList&, Problems&);
PrimPtr makeCone(float height, float radius, float thetaMax_degrees, const ParamList&, Problems&);
PrimPtr makeCylinder(float radius, float zmin, float zmax, float thetaMax_degrees, const ParamList&, Problems&);
PrimPtr makeHyperboloid(const vec3& point1, const vec3& point2, float thetaMax_degrees, const ParamList&, Problems&);
PrimPtr makeParaboloid(float rmax, float zmin, float zmax, float thetaMax_degrees, const ParamList&, Problems&);
PrimPtr makeDisk(float height, float radius, float thetaMax_degrees, const ParamList&, Problems&);
PrimPtr makeTorus(float major, float minor, float phiMin_degrees, float phiMax_degrees, float thetaMax_degrees,
                  const ParamList&, Problems&);

/// The facts of a quadric that reading RIB needs. A new quadric needs one entry of quadrics() in
/// reyes/prim/quadrics.cpp and nothing else in RIB; plugins call it by reyes/ri.h.
struct Quadric {
  std::string_view name;
  int numberCount;
  PrimPtr (*make)(const float* numbers, const ParamList&, Problems&);
  std::vector<int> sizes;  ///< Indices of the numbers that must not be 0, such as a radius.
  /// The `extentCount` numbers from index `from` on must differ from those from `to` on, as zmin and zmax must.
  int from = 0, to = 0, extentCount = 0;

  /// Tells whether these numbers leave nothing of the surface. That is no error at a key of a motion.
  bool hasNoArea(const float* numbers) const;
};
const std::vector<Quadric>& quadrics();
/// Returns null if no quadric has that name.
const Quadric* findQuadric(std::string_view name);

/// Faces of any size and convexity, without holes. `vertexCounts` per face, `vertices` concatenated. Polygon is the
/// same with one face. Degenerate faces (fewer than three distinct vertices) are dropped with a problem. `keys`:
/// positions of a moving mesh's points at every key, so that all keys are cut alike, and drop the same faces.
using PointKeys = std::vector<std::vector<vec3>>;
PrimPtr makePolygons(const std::vector<int>& vertexCounts, const std::vector<int>& vertices, const ParamList&,
                     Problems&, const PointKeys& keys = {});
/// Faces with holes: `loopCounts` loops per face, the first its outline; `vertexCounts` per loop. Holes may have either
/// orientation.
PrimPtr makeGeneralPolygons(const std::vector<int>& loopCounts, const std::vector<int>& vertexCounts,
                            const std::vector<int>& vertices, const ParamList&, Problems&, const PointKeys& keys = {});

/// A spline basis (rows as RISpec prints them, power-basis coefficients from control values) and its step.
struct Basis {
  mat4 matrix;
  int step;
};
Basis bezierBasis();
Basis bsplineBasis();
Basis catmullRomBasis();
Basis hermiteBasis();
Basis powerBasis();

PrimPtr makeBilinearPatchMesh(int nu, bool uPeriodic, int nv, bool vPeriodic, const ParamList&, Problems&);
PrimPtr makeBicubicPatchMesh(int nu, bool uPeriodic, const Basis& uBasis, int nv, bool vPeriodic, const Basis& vBasis,
                             const ParamList&, Problems&);

/// One direction of a NuPatch: `knots` are controls + order numbers that never decrease; the part from min to max is
/// drawn.
struct NurbsDirection {
  int controls, order;
  std::vector<float> knots;
  float min, max;
  bool operator==(const NurbsDirection&) const = default;
};
/// A rational B-spline curve in the parameter plane of a NuPatch; `controls` are (u w, v w, w), with weights above
/// zero.
struct TrimCurve {
  NurbsDirection line;
  std::vector<vec3> controls;
  bool operator==(const TrimCurve&) const = default;
};
/// Loops of curves that follow each other. A point is inside if a ray from it crosses them an odd number of times.
struct TrimLoops {
  std::vector<std::vector<TrimCurve>> loops;
  bool keepsInside = false;  ///< True keeps the inside; false cuts it away.
  bool operator==(const TrimLoops&) const = default;
};
/// Positions are "P", or "Pw" with weights above zero. Orders are 2 to 32. u and v run from 0 to 1 over min..max.
PrimPtr makeNuPatch(const NurbsDirection& u, const NurbsDirection& v, const TrimLoops&, const ParamList&, Problems&);

/// Disks: round, as wide as "constantwidth" or "width" says (1 if absent), facing "N" or else the eye. "type" makes
/// them spheres ("sphere") or cards ("patch", with "patchaspectratio", width over height, and "patchangle" in degrees).
/// Each has one patch.
PrimPtr makePoints(const ParamList&, Problems&);

/// Ribbons, u across and v along, as wide as "width" or "constantwidth" says (1 if absent), with the normal "N" or else
/// facing the eye. Each segment has one patch. `basis` is for cubic curves.
PrimPtr makeCurves(bool cubic, const Basis& basis, const std::vector<int>& vertexCounts, bool periodic,
                   const ParamList&, Problems&);
/// Makes the same curves as tubes: u runs around. Loose ends wider than 0 are closed by flat disks, which are patches
/// that follow those of the segments.
PrimPtr makeTubes(bool cubic, const Basis& basis, const std::vector<int>& vertexCounts, bool periodic, const ParamList&,
                  Problems&);

/// Newell's teapot, 3.15 high, on z = 0 with its spout towards x. Primvars run over every patch in the same way.
PrimPtr makeTeapot(const ParamList&, Problems&);

/// Returns the box of a density, whose normals point outwards.
PrimPtr makeVolume(std::shared_ptr<const DensityGrid> density, Problems&);

/// A depth picture, seen by its camera. Its surfaces repel a Blobby.
struct GroundPicture {
  int width = 0, height = 0;
  std::vector<float> depth;  ///< Row by row; infinite where there is no surface.
  mat4 cameraFromObject{1.0f};
  mat4 texelFromObject{1.0f};  ///< Homogeneous; texel (0, 0) is the square from (0, 0) to (1, 1).
};
/// Reads a picture by the index of its name among the strings of the request. A picture that cannot be read is
/// reported, and the result is empty.
using GroundReader = std::function<std::optional<GroundPicture>(int string)>;

/// Returns the surface where a field, made of leaves and operations on them, is 27/64. `code` and `floats` are as in
/// RIB (reyes/prim/blobby_code.h); varying and vertex primvars have one value for each leaf, and these values blend.
PrimPtr makeBlobby(int leafCount, const std::vector<int>& code, const std::vector<float>& floats, const GroundReader&,
                   const ParamList&, Problems&);
/// Makes a later key of a moving blobby: the mesh of `first` follows its leaves, and is then projected onto the new
/// surface. If `first` is not a Blobby with the same number of leaves, it does the same as makeBlobby().
PrimPtr makeBlobbyKey(const Prim& first, int leafCount, const std::vector<int>& code, const std::vector<float>& floats,
                      const GroundReader&, const ParamList&, Problems&);

/// The tags of a mesh as HierarchicalSubdivisionMesh has them. `argCounts` has three numbers for each name: how many of
/// the ints, floats and strings belong to the tag.
struct SubdivisionTags {
  std::vector<std::string> names;
  std::vector<int> argCounts, ints;
  std::vector<float> floats;
  std::vector<std::string> strings;
};
/// Makes the limit surface by OpenSubdiv. `scheme` is "catmull-clark", "loop" (triangles only) or "bilinear".
PrimPtr makeSubdivisionMesh(const std::string& scheme, const std::vector<int>& vertexCounts,
                            const std::vector<int>& vertices, const SubdivisionTags& tags, const ParamList&, Problems&);

}  // namespace tomales

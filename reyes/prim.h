// Noun: geometry. A Prim is an immutable surface made of one or more *patches*, each over the unit square (u,v);
// splitting a primitive is taking a smaller rectangle of one patch, so every vertex that two pieces share is
// evaluated from the same numbers.
//   bound     a box that contains a rectangle of a patch
//   evaluate  positions and derivatives at any points of a patch: dicing a lattice and shading a ray hit are one call
//   facing    shapes that are drawn flat towards the eye, turned towards one
//   kept      what trim curves leave
//   never     knows a camera, an attribute or a shader
// Space: everything is in object space. Threads: const members may be called concurrently.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "reyes/base/math.h"
#include "reyes/base/value.h"

namespace tomales {

struct UvRect {
  float u0 = 0, u1 = 1, v0 = 0, v1 = 1;
};

/// Bits for the four edges of a patch, in the order of PatchInfo::openEdges.
enum PatchEdge : uint8_t { kEdgeU0 = 1, kEdgeU1 = 2, kEdgeV0 = 4, kEdgeV1 = 8, kAllEdges = 15 };

struct PatchInfo {
  bool planar = false;            ///< Flat, with straight edges: two triangles are exact.
  uint8_t openEdges = kAllEdges;  ///< Edges that end the surface; the others have a neighbour to join without cracks.
  bool disk = false;              ///< A disk: a lattice of one cell over the whole of it is a square of its area.
};

/// How much of something trim curves leave.
enum class Kept : uint8_t { All, Part, None };

/// What evaluate() fills: structure of arrays, each at least n long.
struct SurfacePoints {
  float *px, *py, *pz;
  float *dux, *duy, *duz;  ///< dP/du by patch parameter
  float *dvx, *dvy, *dvz;
  float *nx, *ny, *nz;  ///< Outward RISpec normal for Orientation "outside": dPdu x dPdv where that is defined, its
                        ///< limit at poles and degenerate corners. Not normalised; never zero for a real surface.
};

/// A primitive variable as it came in RIB, values in element order.
struct Primvar {
  std::string name;
  Storage storage;
  ValueType type;
  int width;  ///< Floats of one element.
  std::vector<float> values;
};

/// Of a variable among the floats of a point, which has those of all in their order; -1: there is none of that name.
int offsetOf(const std::vector<Primvar>& primvars, std::string_view name);

/// A whole sphere, or a whole flat disk.
struct RoundShape {
  vec3 center;
  float radius;
  vec3 axis;  ///< Of a disk; 0: a sphere
};

class Prim {
 public:
  virtual ~Prim() = default;

  virtual uint32_t patchCount() const = 0;
  virtual PatchInfo info(uint32_t patch) const = 0;

  /// Contains every point of the rectangle (conservative), and the vertices of any lattice over a whole patch.
  virtual Bound3 bound(uint32_t patch, const UvRect& rect) const = 0;

  virtual void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const = 0;

  /// The vertices of a lattice of nu x nv over a whole patch, rows along u. Like evaluate(), except that a small round
  /// shape pushes them outward, so that its few polygons have the area of what they stand for.
  virtual void evaluateLattice(uint32_t patch, int nu, int nv, const float* u, const float* v,
                               SurfacePoints out) const {
    evaluate(patch, (nu + 1) * (nv + 1), u, v, out);
  }

  /// Surface parameters u,v as shaders see them: over the whole primitive, 0..1 (a polygon: object-space x,y).
  virtual void surfaceParameters(uint32_t patch, int n, const float* u, const float* v, float* su, float* sv) const;

  /// Interpolates primvars()[index]: component c of point i goes to out[c * stride + i].
  virtual void interpolate(uint32_t patch, int index, int n, const float* u, const float* v, float* out,
                           int stride) const = 0;

  /// What shape it is as a whole, if it is that simple.
  virtual std::optional<RoundShape> round() const { return std::nullopt; }

  /// The same shape turned towards an eye, for points and curves that face it: `eye` is a position if `perspective`,
  /// else only the direction `forward`, in which it looks, counts. Null: the shape looks the same to every eye.
  virtual std::shared_ptr<const Prim> facing(const vec3& /*eye*/, const vec3& /*forward*/, bool /*perspective*/) const {
    return nullptr;
  }

  /// What trim curves leave of a rectangle, which may reach beyond the patch; `Part` if in doubt.
  virtual Kept kept(uint32_t /*patch*/, const UvRect& /*rect*/) const { return Kept::All; }
  /// Do trim curves leave this point?
  virtual bool keeps(uint32_t /*patch*/, float /*u*/, float /*v*/) const { return true; }

  /// Memory that it holds, near enough.
  size_t bytes() const;

  /// Those other than P, in a fixed order. "st" arrives split into "s" and "t".
  const std::vector<Primvar>& primvars() const { return primvars_; }

 protected:
  explicit Prim(std::vector<Primvar> primvars) : primvars_(std::move(primvars)) {}
  /// Beside its primvars.
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

/// Turns a RIB parameter list into primvars for `counts` elements of each storage. Values of a wrong count are an error
/// for P/Pw/Pz, and dropped with a sentence in `problems` for all others.
struct PrimvarCounts {
  size_t uniform = 1, varying = 4, vertex = 4, faceVarying = 4;
};
std::vector<Primvar> takePrimvars(const ParamList& params, const PrimvarCounts& counts,
                                  std::vector<std::string>& problems);

// Every factory takes the parameter list after the positional arguments and appends to `problems` what it dropped.
using Problems = std::vector<std::string>;
PrimPtr makeSphere(float radius, float zmin, float zmax, float thetaMax_degrees, const ParamList&, Problems&);
PrimPtr makeCone(float height, float radius, float thetaMax_degrees, const ParamList&, Problems&);
PrimPtr makeCylinder(float radius, float zmin, float zmax, float thetaMax_degrees, const ParamList&, Problems&);
PrimPtr makeHyperboloid(const vec3& point1, const vec3& point2, float thetaMax_degrees, const ParamList&, Problems&);
PrimPtr makeParaboloid(float rmax, float zmin, float zmax, float thetaMax_degrees, const ParamList&, Problems&);
PrimPtr makeDisk(float height, float radius, float thetaMax_degrees, const ParamList&, Problems&);
PrimPtr makeTorus(float major, float minor, float phiMin_degrees, float phiMax_degrees, float thetaMax_degrees,
                  const ParamList&, Problems&);

/// Faces of any size and convexity, without holes. `vertexCounts` per face, `vertices` concatenated.
/// Polygon is the same with one face. Degenerate faces (fewer than three distinct vertices) are dropped with a problem.
/// `keys`: where the points of one that moves are at every key, so that all are cut, and faces dropped, alike.
using PointKeys = std::vector<std::vector<vec3>>;
PrimPtr makePolygons(const std::vector<int>& vertexCounts, const std::vector<int>& vertices, const ParamList&,
                     Problems&, const PointKeys& keys = {});
/// With holes: `loopCounts` loops per face, the first its outline; `vertexCounts` per loop. Holes may go either way.
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

/// One direction of a NuPatch: `knots` are controls + order numbers that never decrease; min to max is drawn.
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
  bool keepsInside = false;  ///< Else the inside is cut away.
  bool operator==(const TrimLoops&) const = default;
};
/// Positions are "P", or "Pw" with weights above zero. Orders 2 to 32. u,v run from 0 to 1 over min..max.
PrimPtr makeNuPatch(const NurbsDirection& u, const NurbsDirection& v, const TrimLoops&, const ParamList&, Problems&);

/// Disks: round, as wide as "constantwidth" or "width" says (1 if absent), facing "N" or else the eye. "type" makes
/// them spheres
/// ("sphere") or cards ("patch", with "patchaspectratio", width over height, and "patchangle" in degrees). One patch
/// each.
PrimPtr makePoints(const ParamList&, Problems&);

/// Ribbons, u across and v along, as wide as "width" or "constantwidth" says (1 if absent), with the normal "N" or else
/// facing the eye. One patch a segment. `basis` is for cubic curves.
PrimPtr makeCurves(bool cubic, const Basis& basis, const std::vector<int>& vertexCounts, bool periodic,
                   const ParamList&, Problems&);
/// The same as tubes: u around. Loose ends wider than 0 are closed by flat disks, patches that follow the segments.
PrimPtr makeTubes(bool cubic, const Basis& basis, const std::vector<int>& vertexCounts, bool periodic, const ParamList&,
                  Problems&);

/// Newell's teapot, 3.15 high, on z = 0 with its spout towards x. Primvars run over every patch alike.
PrimPtr makeTeapot(const ParamList&, Problems&);

/// A picture of depth, seen by its camera, whose surfaces keep a Blobby away.
struct GroundPicture {
  int width = 0, height = 0;
  std::vector<float> depth;  ///< Row by row; infinite where there is nothing.
  mat4 cameraFromObject{1.0f};
  mat4 texelFromObject{1.0f};  ///< Homogeneous; texel (0, 0) is the square from there to (1, 1).
};
/// That of a string of the request. Nothing: it cannot be read, and the user knows.
using GroundReader = std::function<std::optional<GroundPicture>(int string)>;

/// The surface where a field that leaves and operations on them make is 27/64. `code` and `floats` as RIB gives them
/// (reyes/prim/blobby_code.h); varying and vertex primvars have a value for each leaf and blend.
PrimPtr makeBlobby(int leafCount, const std::vector<int>& code, const std::vector<float>& floats, const GroundReader&,
                   const ParamList&, Problems&);
/// A later key of a moving one: the mesh of `first` goes where its leaves go, and from there onto the new surface. If
/// `first` is no Blobby of as many leaves: makeBlobby().
PrimPtr makeBlobbyKey(const Prim& first, int leafCount, const std::vector<int>& code, const std::vector<float>& floats,
                      const GroundReader&, const ParamList&, Problems&);

/// Schemes "catmull-clark", "loop" (triangles only) and "bilinear" by OpenSubdiv's limit surface. Tags as
/// HierarchicalSubdivisionMesh gives them: per tag a name and {number of ints, number of floats, number of strings}.
struct SubdivisionTags {
  std::vector<std::string> names;
  std::vector<int> argCounts, ints;
  std::vector<float> floats;
  std::vector<std::string> strings;
};
PrimPtr makeSubdivisionMesh(const std::string& scheme, const std::vector<int>& vertexCounts,
                            const std::vector<int>& vertices, const SubdivisionTags& tags, const ParamList&, Problems&);

}  // namespace tomales

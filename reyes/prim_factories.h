// Verb: the numbers of a request -> Prim. There is a factory for each kind of primitive in RISpec 3.2 section 5. They
// check their input, and throw PrimError with a sentence for the user; the caller adds file:line. Space: object space.
// Threads: plain functions.
#pragma once
#include <functional>
#include <stdexcept>

#include "reyes/prim.h"

namespace tomales {

struct PrimError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

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

// The limit surface that we draw (OpenSubdiv's Bfr) against another evaluator of it: Far's patch tables, refined
// adaptively so deep that what is left around an extraordinary vertex is smaller than what we compare.
#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/ptexIndices.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include "tests/unit/prim/subdivision.h"

namespace tomales {
namespace {
using namespace test;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

struct Point {
  glm::dvec3 p{0};
  void Clear() { p = {}; }
  void AddWithWeight(const Point& other, double w) { p += w * other.p; }
};

class FarLimit {
 public:
  FarLimit(const Cage& cage, Sdc::SchemeType scheme) {
    Far::TopologyDescriptor d;
    d.numVertices = static_cast<int>(cage.points.size() / 3);
    d.numFaces = static_cast<int>(cage.counts.size());
    d.numVertsPerFace = cage.counts.data();
    d.vertIndicesPerFace = cage.vertices.data();
    d.numCreases = static_cast<int>(cage.sharpness.size());
    d.creaseVertexIndexPairs = cage.creaseEdges.data();
    d.creaseWeights = cage.sharpness.data();
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    refiner_.reset(Factory::Create(d, Factory::Options(scheme, options)));
    constexpr int kDeepest = 10;
    refiner_->RefineAdaptive(Far::TopologyRefiner::AdaptiveOptions(kDeepest));
    Far::PatchTableFactory::Options tableOptions(kDeepest);
    tableOptions.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
    tableOptions.SetPatchPrecision<double>();
    table_.reset(Far::PatchTableFactory::Create(*refiner_, tableOptions));
    map_ = std::make_unique<Far::PatchMap>(*table_);
    refine(cage);
  }

  /// Coordinates of a face as Far's ptex faces have them.
  Sample at(int face, double u, double v) const {
    const Far::PatchTable::PatchHandle* handle = map_->FindPatch(face, u, v);
    double weight[20], byU[20], byV[20];
    table_->EvaluateBasis(*handle, u, v, weight, byU, byV);
    glm::dvec3 p(0), du(0), dv(0);
    const Far::ConstIndexArray controls = table_->GetPatchVertices(*handle);
    for (int k = 0; k < controls.size(); ++k) {
      const glm::dvec3& c = points_[static_cast<size_t>(controls[k])].p;
      p += weight[k] * c;
      du += byU[k] * c;
      dv += byV[k] * c;
    }
    return {vec3(p), vec3(du), vec3(dv), {}};
  }

 private:
  void refine(const Cage& cage) {
    const size_t local = static_cast<size_t>(table_->GetNumLocalPoints());
    points_.resize(static_cast<size_t>(refiner_->GetNumVerticesTotal()) + local);
    for (size_t k = 0; 3 * k < cage.points.size(); ++k)
      points_[k].p = {cage.points[3 * k], cage.points[3 * k + 1], cage.points[3 * k + 2]};
    const Far::PrimvarRefinerReal<double> primvars(*refiner_);
    Point* from = points_.data();
    for (int level = 1; level <= refiner_->GetMaxLevel(); ++level) {
      Point* to = from + refiner_->GetLevel(level - 1).GetNumVertices();
      primvars.Interpolate(level, from, to);
      from = to;
    }
    table_->GetLocalPointStencilTable<double>()->UpdateValues(points_.data(), &points_[points_.size() - local]);
  }

  std::unique_ptr<Far::TopologyRefiner> refiner_;
  std::unique_ptr<Far::PatchTable> table_;
  std::unique_ptr<Far::PatchMap> map_;
  std::vector<Point> points_;
};

struct Errors {
  double position = 0, derivative = 0;  ///< Largest, relative to the size of the mesh.
  void add(const Sample& a, const Sample& b, double size) {
    position = std::max<double>(position, glm::length(a.p - b.p) / size);
    derivative = std::max<double>(derivative, std::max(glm::length(a.du - b.du), glm::length(a.dv - b.dv)) / size);
  }
};

constexpr int kPoints = 1000;
float random(int k, uint32_t what) { return unitFloat(hashCombine(static_cast<uint32_t>(k), what)); }

/// Every patch is one of Far's ptex faces: whole quadrilaterals, and the corners of others in turn, where Far's
/// derivatives are by coordinates of twice the patch: `scale` 1/2.
Errors quadrilateralErrors(const Cage& cage, double size, float scale = 1) {
  const PrimPtr prim = meshOf(cage, "catmull-clark");
  const FarLimit reference(cage, Sdc::SCHEME_CATMARK);
  Errors errors;
  for (int k = 0; k < kPoints; ++k) {
    const auto patch = static_cast<uint32_t>(k) % prim->patchCount();
    const float u = random(k, 1), v = random(k, 2);
    const Sample far = reference.at(static_cast<int>(patch), u, v);
    errors.add(sampleAt(*prim, patch, u, v), {far.p, scale * far.du, scale * far.dv, {}}, size);
  }
  return errors;
}

const Cage kCubeCage = {{4, 4, 4, 4, 4, 4},
                        {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7},
                        {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1},
                        {},
                        {}};

TEST(SubdivisionLimit, OfACubeIsFars) {
  const Errors errors = quadrilateralErrors(kCubeCage, 2);
  EXPECT_LT(errors.position, 1e-5);
  EXPECT_LT(errors.derivative, 1e-4);
}

TEST(SubdivisionLimit, NextToCreasesIsFars) {
  Cage cage = kCubeCage;
  cage.creaseEdges = {4, 5, 5, 6, 0, 3};
  cage.sharpness = {10, 2.5f, 1};
  const Errors errors = quadrilateralErrors(cage, 2);
  EXPECT_LT(errors.position, 1e-5);
  EXPECT_LT(errors.derivative, 1e-4);
}

TEST(SubdivisionLimit, OfTrianglesUnderCatmullClarkIsFars) {
  const Cage cage = {{3, 3, 3, 3}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {}, {}};
  const Errors errors = quadrilateralErrors(cage, 1, 0.5f);
  EXPECT_LT(errors.position, 1e-5);
  EXPECT_LT(errors.derivative, 1e-4);
}

/// A cap of one face with `sides` corners, and a wall of quadrilaterals that leads to a pole where they meet.
Cage drumCage(int sides) {
  Cage cage;
  cage.counts.push_back(sides);
  for (int k = 0; k < sides; ++k) cage.vertices.push_back(k);
  cage.points.clear();
  for (const float height : {0.0f, 1.0f})
    for (int k = 0; k < sides; ++k) {
      const float angle = 2 * kPi * static_cast<float>(k) / static_cast<float>(sides);
      cage.points.insert(cage.points.end(), {std::cos(angle), std::sin(angle), height + 0.2f * std::cos(3 * angle)});
    }
  cage.points.insert(cage.points.end(), {0, 0, 1.5f});
  for (int k = 0; k < sides; ++k) {
    const int next = (k + 1) % sides;
    cage.counts.push_back(4);
    cage.vertices.insert(cage.vertices.end(), {next, k, sides + k, sides + next});
    cage.counts.push_back(3);
    cage.vertices.insert(cage.vertices.end(), {sides + k, 2 * sides, sides + next});
  }
  return cage;
}

TEST(SubdivisionLimit, OfFacesInACrowdIsFars) {
  constexpr int kSides = 70;
  const Cage cage = drumCage(kSides);
  const PrimPtr prim = meshOf(cage, "catmull-clark");
  ASSERT_EQ(prim->patchCount(), kSides + 4u * kSides);
  const FarLimit reference(cage, Sdc::SCHEME_CATMARK);
  Errors errors;
  for (int k = 0; k < kPoints; ++k) {
    const auto patch = static_cast<uint32_t>(k) % prim->patchCount();
    const float u = random(k, 1), v = random(k, 2);
    const bool whole = patch >= kSides && (patch - kSides) % 4 == 0;
    const float scale = whole ? 1 : 0.5f;
    const Sample far = reference.at(static_cast<int>(patch), u, v);
    errors.add(sampleAt(*prim, patch, u, v), {far.p, scale * far.du, scale * far.dv, {}}, 2);
  }
  EXPECT_LT(errors.position, 1e-5);
  EXPECT_LT(errors.derivative, 1e-4);
}

TEST(SubdivisionLimit, OfAPoleOfManyFacesIsHalsteads) {
  // (n^2 V + 4 sum E + sum F) / (n (n + 5)) of the mesh subdivided once (Halstead et al. 1993); here the mesh is flat
  // but for the pole, at height 1, so that only the weights of V, of edge points and of face points count.
  for (const int n : {8, 60, 300}) {
    Cage cage;
    cage.points = {0, 0, 1};
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * M_PI * k / n;
      cage.points.insert(cage.points.end(),
                         {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
      cage.counts.push_back(3);
      cage.vertices.insert(cage.vertices.end(), {0, 1 + k, 1 + (k + 1) % n});
    }
    const double face = 1.0 / 3, edge = (1 + 2 * face) / 4, vertex = (n - 2.0) / n + face / n;
    const double height = (n * n * vertex + 4 * n * edge + n * face) / (n * (n + 5.0));
    EXPECT_NEAR(sampleAt(*meshOf(cage, "catmull-clark"), 0, 0, 0).p.z, height, 3e-5) << n;  // sums of n floats
  }
}

void expectLoopIsFars(const Cage& cage) {
  const PrimPtr prim = meshOf(cage, "loop");
  ASSERT_EQ(prim->patchCount(), 3 * cage.counts.size());
  const FarLimit reference(cage, Sdc::SCHEME_LOOP);
  Errors errors;
  for (int k = 0; k < kPoints; ++k) {
    const auto patch = static_cast<uint32_t>(k) % prim->patchCount();
    const float u = random(k, 1), v = random(k, 2);
    // The patch is the corner's bilinear quadrilateral of the triangle's coordinates.
    const auto corner = [&](uint32_t i) { return vec2(i % 3 == 1, i % 3 == 2); };
    const uint32_t c = patch % 3;
    const vec2 a = corner(c), b = 0.5f * (a + corner(c + 1)), d = 0.5f * (a + corner(c + 2)), e(1 / 3.0f);
    const vec2 at = (1 - u) * ((1 - v) * a + v * d) + u * ((1 - v) * b + v * e);
    const vec2 byU = (1 - v) * (b - a) + v * (e - d), byV = (1 - u) * (d - a) + u * (e - b);
    const Sample far = reference.at(static_cast<int>(patch / 3), at.x, at.y);
    errors.add(sampleAt(*prim, patch, u, v),
               {far.p, byU.x * far.du + byU.y * far.dv, byV.x * far.du + byV.y * far.dv, {}}, 2);
  }
  EXPECT_LT(errors.position, 1e-5);
  EXPECT_LT(errors.derivative, 1e-4);
}

TEST(SubdivisionLimit, LoopsIsFars) {
  // An octahedron with a pyramid on one face: valences 3 to 5; its boundary is a triangle left out.
  expectLoopIsFars({{3, 3, 3, 3, 3, 3, 3, 3, 3},
                    {0, 1, 2, 0, 2, 3, 0, 3, 4, 5, 2, 1, 5, 3, 2, 5, 4, 3, 5, 1, 6, 1, 4, 6, 4, 5, 6},
                    {0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, -1, 1, -1, -1},
                    {1, 2, 2, 3},
                    {10, 1.5f}});
}

TEST(SubdivisionLimit, LoopsInACrowdIsFars) {
  constexpr int kSides = 60;
  Cage cage;
  cage.points = {0, 0, 1, 0, 0, -1};
  for (int k = 0; k < kSides; ++k) {
    const float angle = 2 * kPi * static_cast<float>(k) / kSides;
    cage.points.insert(cage.points.end(), {std::cos(angle), std::sin(angle), 0.2f * std::cos(3 * angle)});
    const int here = 2 + k, next = 2 + (k + 1) % kSides;
    cage.counts.insert(cage.counts.end(), {3, 3});
    cage.vertices.insert(cage.vertices.end(), {0, here, next, 1, next, here});
  }
  expectLoopIsFars(cage);
}

}  // namespace
}  // namespace tomales

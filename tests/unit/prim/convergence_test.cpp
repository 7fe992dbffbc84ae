// What every primitive is diced into tends to it: area, and volume where it encloses one, at second order
// (docs/measured/primitives.md).
#include "tests/unit/prim/subdivision.h"
#include "tests/unit/prim/thin.h"

namespace tomales {
namespace {
using namespace test;

struct Case {
  const char* name;
  PrimPtr prim;
  bool closed = false;
  int coarsest = 8;  ///< Cells along u and v of a patch.
};

struct Measured {
  double area = 0, volume = 0;
};

/// The area and volume of a mesh of two triangles a cell; the volume is by the divergence theorem.
Measured diced(const Prim& prim, int side) {
  Measured out;
  const int row = side + 1;
  std::vector<float> u, v;
  for (int k = 0; k < row * row; ++k) {
    u.push_back(static_cast<float>(k % row) / side);
    v.push_back(static_cast<float>(k / row) / side);
  }
  for (uint32_t patch = 0; patch < prim.patchCount(); ++patch) {
    const std::vector<Sample> s = samplesAt(prim, patch, u, v);
    const glm::dvec3 origin = sampleAt(prim, 0, 0, 0).p;
    const auto triangle = [&](int a, int b, int c) {
      const glm::dvec3 A = glm::dvec3(s[static_cast<size_t>(a)].p) - origin,
                       B = glm::dvec3(s[static_cast<size_t>(b)].p) - origin,
                       C = glm::dvec3(s[static_cast<size_t>(c)].p) - origin;
      out.area += glm::length(cross(B - A, C - A)) / 2;
      out.volume += dot(A, cross(B, C)) / 6;
    };
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const int k = j * row + i;
        triangle(k, k + 1, k + row);
        triangle(k + 1, k + row + 1, k + row);
      }
  }
  return out;
}

/// The exponent with which an error falls in the step, from three steps: 2 if it is divided by four with each halving.
/// What is exact from the beginning counts as that too.
double order(double coarse, double medium, double fine) {
  const double first = std::abs(coarse - medium), second = std::abs(medium - fine);
  return first < 2e-6 * std::abs(fine) ? 2 : std::log2(first / second);
}

std::vector<Case> cases() {
  Problems none;
  const std::vector<float> wave = [] {
    std::vector<float> p;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
        p.insert(p.end(), {static_cast<float>(i), static_cast<float>(j), static_cast<float>((i * 2 + j * 3) % 5)});
    return p;
  }();
  Mesh pyramid = {{3, 3, 3, 3, 3, 3, 3, 3},
                  {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 5, 2, 1, 5, 3, 2, 5, 4, 3, 5, 1, 4},
                  {positions({0, 1.4f, 0, 1, 0, 1, -1, 0, 1, -1, 0, -1, 1, 0, -1, 0, -1.4f, 0})},
                  {},
                  "loop"};
  Mesh flat = cube();
  flat.scheme = "bilinear";
  const NurbsDirection four{4, 4, {0, 0, 0, 0, 1, 1, 1, 1}, 0, 1};
  const Param ball = floats("type", Storage::Uniform, ValueType::String, {});
  ParamList spheres{positions({1, 2, 3}), width(Storage::Constant, {2}), ball};
  spheres[2].strings = {"sphere"};
  return {
      {"Sphere", makeSphere(2, -2, 2, 360, {}, none), true},
      {"SphereZone", makeSphere(2, -1, 1.5f, 90, {}, none)},
      {"Cone", makeCone(3, 2, 360, {}, none)},
      {"Cylinder", makeCylinder(2, -1, 3, 360, {}, none)},
      {"Hyperboloid", makeHyperboloid({1, -1, -1}, {0.5f, 2, 3}, 360, {}, none)},
      {"Paraboloid", makeParaboloid(2, 0.5f, 3, 360, {}, none)},
      {"Disk", makeDisk(0.5f, 2, 360, {}, none)},
      {"Torus", makeTorus(3, 1, 0, 360, 360, {}, none), true},
      {"Polygon",
       makePolygons({5}, {0, 1, 2, 3, 4}, {positions({0, 0, 0, 2, 0, 0, 3, 1, 0, 1, 3, 0, -1, 1, 0})}, none)},
      {"BilinearPatch",
       makeBilinearPatchMesh(2, false, 2, false, {positions({0, 0, 0, 1, 0, 1, 0, 1, 1, 1, 1, 0})}, none)},
      {"BicubicPatch", makeBicubicPatchMesh(4, false, bezierBasis(), 4, false, bezierBasis(), {positions(wave)}, none)},
      {"NuPatch", makeNuPatch(four, four, {}, {positions(wave)}, none)},
      {"CatmullClark", cube().make(), true},
      {"CatmullClarkCreased", cube().tag("crease", {0, 1, 2, 3, 0}, {2}).make(), true},
      {"Loop", pyramid.make(), true},
      {"BilinearSubdivision", flat.make(), true},
      {"PointsDisks",
       makePoints({positions({0, 0, 0, 3, 1, 0}), width(Storage::Constant, {2})}, none)->facing(kEye, {0, 0, 1}, true)},
      {"PointsSpheres", makePoints(spheres, none), true},
      {"Ribbon",
       makeCurves(true, bsplineBasis(), {6}, false, {positions(wiggle(6)), width(Storage::Constant, {0.1f})}, none)
           ->facing(kEye, {0, 0, 1}, true),
       false, 16},
      {"Tube",
       makeTubes(true, bsplineBasis(), {6}, false, {positions(wiggle(6)), width(Storage::Constant, {0.1f})}, none),
       true, 16},
      {"Teapot", makeTeapot({}, none)},
      {"Blobby", makeBlobby(1, {1001, 0}, {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1}, {}, {}, none), true, 2}};
}

class Convergence : public testing::TestWithParam<Case> {};

TEST_P(Convergence, OfAreaAndVolumeIsOfSecondOrder) {
  const Case& c = GetParam();
  const Measured coarse = diced(*c.prim, c.coarsest), medium = diced(*c.prim, 2 * c.coarsest),
                 fine = diced(*c.prim, 4 * c.coarsest);
  const double byArea = order(coarse.area, medium.area, fine.area),
               byVolume = order(coarse.volume, medium.volume, fine.volume);
  EXPECT_NEAR(byArea, 2, 0.2) << coarse.area << ' ' << medium.area << ' ' << fine.area;
  if (c.closed) {
    EXPECT_NEAR(byVolume, 2, 0.2) << coarse.volume << ' ' << medium.volume << ' ' << fine.volume;
  }
  RecordProperty("area", std::to_string(byArea));
  RecordProperty("volume", c.closed ? std::to_string(byVolume) : "open");
}

INSTANTIATE_TEST_SUITE_P(Primitives, Convergence, testing::ValuesIn(cases()),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace tomales

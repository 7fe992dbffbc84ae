// Positions and derivatives against each primitive's definition, written down independently in double precision: 1000
// random points, 1e-5 of the size for positions, 1e-4 for first derivatives.
#include <functional>

#include "tests/unit/prim/support.h"

namespace tomales {
namespace {
using namespace test;

using Definition = std::function<glm::dvec3(double u, double v)>;  ///< On one patch.

void expectDefinition(const Prim& prim, uint32_t patch, const Definition& p, int points) {
  std::vector<float> u, v;
  for (uint32_t k = 0; k < static_cast<uint32_t>(points); ++k) {
    u.push_back(unitFloat(hashCombine(k, patch, 1u)));
    v.push_back(unitFloat(hashCombine(k, patch, 2u)));
  }
  const std::vector<Sample> got = samplesAt(prim, patch, u, v);
  double size = 0, du = 0, dv = 0, worst = 0, worstDu = 0, worstDv = 0;
  for (size_t k = 0; k < got.size(); ++k) {
    constexpr double h = 1e-5;
    const glm::dvec3 at = p(u[k], v[k]), byU = (p(u[k] + h, v[k]) - p(u[k] - h, v[k])) / (2 * h),
                     byV = (p(u[k], v[k] + h) - p(u[k], v[k] - h)) / (2 * h);
    size = std::max(size, glm::length(at));
    du = std::max(du, glm::length(byU));
    dv = std::max(dv, glm::length(byV));
    worst = std::max(worst, glm::length(glm::dvec3(got[k].p) - at));
    worstDu = std::max(worstDu, glm::length(glm::dvec3(got[k].du) - byU));
    worstDv = std::max(worstDv, glm::length(glm::dvec3(got[k].dv) - byV));
  }
  EXPECT_LE(worst, 1e-5 * size) << "patch " << patch;
  EXPECT_LE(worstDu, 1e-4 * du) << "patch " << patch;
  EXPECT_LE(worstDv, 1e-4 * dv) << "patch " << patch;
}

constexpr double kTurn = M_PI / 180;

glm::dvec3 turned(double theta, double r, double z) { return {r * std::cos(theta), r * std::sin(theta), z}; }

// RISpec 3.2 section 5.4.
TEST(Definition, IsFollowedByEveryQuadricWholeAndPartial) {
  Problems none;
  for (const double sweep : {360.0, 200.0, -77.0, 1.0}) {
    const float s = static_cast<float>(sweep);
    const auto theta = [sweep](double u) { return u * sweep * kTurn; };
    for (const auto& [r, z0, z1] : {std::array{2.0, -2.0, 2.0}, {2.0, -1.0, 1.5}, {0.001, 0.0, 0.0005}}) {
      const double phi0 = std::asin(std::max(z0 / r, -1.0)), phi1 = std::asin(std::min(z1 / r, 1.0));
      expectDefinition(
          *makeSphere(static_cast<float>(r), static_cast<float>(z0), static_cast<float>(z1), s, {}, none), 0,
          [&, radius = r](double u, double v) {
            const double phi = phi0 + v * (phi1 - phi0);
            return turned(theta(u), radius * std::cos(phi), radius * std::sin(phi));
          },
          1000);
    }
    expectDefinition(
        *makeCone(3, 2, s, {}, none), 0, [&](double u, double v) { return turned(theta(u), 2 * (1 - v), 3 * v); },
        1000);
    expectDefinition(
        *makeCylinder(2, -1, 3, s, {}, none), 0, [&](double u, double v) { return turned(theta(u), 2, -1 + 4 * v); },
        1000);
    expectDefinition(
        *makeDisk(0.5f, 2, s, {}, none), 0, [&](double u, double v) { return turned(theta(u), 2 * (1 - v), 0.5); },
        1000);
    expectDefinition(
        *makeParaboloid(2, 0.5f, 3, s, {}, none), 0,
        [&](double u, double v) {
          const double z = 0.5 + 2.5 * v;
          return turned(theta(u), 2 * std::sqrt(z / 3), z);
        },
        1000);
    expectDefinition(
        *makeHyperboloid({1, -1, -1}, {0.5f, 2, 3}, s, {}, none), 0,
        [&](double u, double v) {
          const glm::dvec3 p = glm::mix(glm::dvec3(1, -1, -1), glm::dvec3(0.5, 2, 3), v);
          return glm::dvec3(p.x * std::cos(theta(u)) - p.y * std::sin(theta(u)),
                            p.x * std::sin(theta(u)) + p.y * std::cos(theta(u)), p.z);
        },
        1000);
    expectDefinition(
        *makeTorus(3, 1, 30, 300, s, {}, none), 0,
        [&](double u, double v) {
          const double phi = (30 + 270 * v) * kTurn;
          return turned(theta(u), 3 + std::cos(phi), std::sin(phi));
        },
        1000);
  }
}

double noise(uint32_t i) { return 2 * unitFloat(hash32(i + 99)) - 1; }

/// Control points as doubles, homogeneous; with weights that differ, between 0.5 and 1.5, or all the same.
std::vector<glm::dvec4> randomControls(int nu, int nv, bool rational, float common = 1) {
  std::vector<glm::dvec4> out;
  for (int k = 0; k < nu * nv; ++k) {
    const auto i = static_cast<uint32_t>(4 * k);
    const float w = rational ? static_cast<float>(1 + 0.5 * noise(i)) : common;
    const vec3 p(static_cast<float>(k % nu + 0.4 * noise(i + 1)), static_cast<float>(k / nu + 0.4 * noise(i + 2)),
                 static_cast<float>(noise(i + 3)));
    out.emplace_back(w * p, w);
  }
  return out;
}
Param asParam(const std::vector<glm::dvec4>& controls, bool rational) {
  std::vector<float> values;
  for (const glm::dvec4& h : controls)
    for (int c = 0; c < (rational ? 4 : 3); ++c) values.push_back(static_cast<float>(h[c]));
  return rational ? floats("Pw", Storage::Vertex, ValueType::HPoint, values) : positions(values);
}

struct Direction {
  const char* name;
  Basis basis;
  int controls, patches;
  bool periodic;
};

/// RISpec 3.2 section 5.3: (u^3 u^2 u 1) M G N (v^3 v^2 v 1), M as the specification prints it.
TEST(Definition, IsFollowedByBicubicMeshesInEveryBasisStepAndWrap) {
  const Direction directions[] = {{"bezier", bezierBasis(), 7, 2, false},
                                  {"bezier", bezierBasis(), 6, 2, true},
                                  {"b-spline", bsplineBasis(), 6, 3, false},
                                  {"b-spline", bsplineBasis(), 5, 5, true},
                                  {"catmull-rom", catmullRomBasis(), 5, 2, false},
                                  {"catmull-rom", catmullRomBasis(), 4, 4, true},
                                  {"hermite", hermiteBasis(), 6, 2, false},
                                  {"hermite", hermiteBasis(), 6, 3, true},
                                  {"power", powerBasis(), 8, 2, false},
                                  {"bezier at step 1", {bezierBasis().matrix, 1}, 6, 3, false},
                                  {"b-spline at step 2", {bsplineBasis().matrix, 2}, 8, 3, false}};
  uint32_t turn = 0;
  for (const Direction& u : directions) {
    const Direction& v = directions[(turn * 5 + 3) % std::size(directions)];
    const bool homogeneous = turn++ % 2;
    const auto weighs = [](const Direction& d) { return d.name[0] == 'b'; };  // weights of the others may be negative
    for (const bool rational : {false, true}) {
      if (rational && !(weighs(u) && weighs(v))) continue;
      SCOPED_TRACE(std::string(u.name) + " by " + v.name + (rational ? ", rational" : ""));
      const std::vector<glm::dvec4> controls =
          randomControls(u.controls, v.controls, rational, homogeneous ? 2.0f : 1.0f);
      Problems problems;
      const PrimPtr prim = makeBicubicPatchMesh(u.controls, u.periodic, u.basis, v.controls, v.periodic, v.basis,
                                                {asParam(controls, homogeneous || rational)}, problems);
      EXPECT_TRUE(problems.empty());
      ASSERT_EQ(prim->patchCount(), static_cast<uint32_t>(u.patches * v.patches));
      const auto weight = [](const Basis& b, double t, int k) {
        const double powers[4] = {t * t * t, t * t, t, 1};
        double sum = 0;
        for (int row = 0; row < 4; ++row) sum += powers[row] * double{b.matrix[row][k]};
        return sum;
      };
      for (uint32_t patch = 0; patch < prim->patchCount(); ++patch)
        expectDefinition(
            *prim, patch,
            [&](double s, double t) {
              const int column = static_cast<int>(patch) % u.patches, row = static_cast<int>(patch) / u.patches;
              glm::dvec4 sum(0);
              for (int j = 0; j < 4; ++j)
                for (int i = 0; i < 4; ++i) {
                  const int x = (column * u.basis.step + i) % u.controls, y = (row * v.basis.step + j) % v.controls;
                  sum +=
                      weight(u.basis, s, i) * weight(v.basis, t, j) * controls[static_cast<size_t>(y * u.controls + x)];
                }
              return glm::dvec3(sum) /
                     (rational ? sum.w
                               : controls[0].w);  // Weights of the power and Hermite bases do not add up to one.
            },
            1 + 1000 / static_cast<int>(prim->patchCount()));
    }
  }
}

TEST(Definition, IsFollowedByBilinearMeshes) {
  for (const bool rational : {false, true}) {
    const std::vector<glm::dvec4> c = randomControls(4, 3, rational, 3);
    Problems problems;
    const PrimPtr prim = makeBilinearPatchMesh(4, true, 3, false, {asParam(c, true)}, problems);
    ASSERT_EQ(prim->patchCount(), 8u);
    for (uint32_t patch = 0; patch < 8; ++patch)
      expectDefinition(
          *prim, patch,
          [&](double s, double t) {
            const size_t i = patch % 4, j = patch / 4, k = (i + 1) % 4;
            const glm::dvec4 h =
                glm::mix(glm::mix(c[j * 4 + i], c[j * 4 + k], s), glm::mix(c[j * 4 + 4 + i], c[j * 4 + 4 + k], s), t);
            return glm::dvec3(h) / h.w;
          },
          130);
  }
}

/// The Cox-de Boor definition, order by order: the weights of all controls.
std::vector<double> coxDeBoor(const std::vector<float>& knots, int order, double t) {
  std::vector<double> n;
  for (size_t i = 0; i + 1 < knots.size(); ++i) n.push_back(knots[i] <= t && t < knots[i + 1] ? 1 : 0);
  for (size_t k = 2; k <= static_cast<size_t>(order); ++k)
    for (size_t i = 0; i + k < knots.size(); ++i) {
      const double a = knots[i], b = knots[i + k - 1], c = knots[i + 1], d = knots[i + k];
      n[i] = (b > a ? (t - a) / (b - a) * n[i] : 0) + (d > c ? (d - t) / (d - c) * n[i + 1] : 0);
    }
  return n;
}

TEST(Definition, IsFollowedByRationalBSplinesOfOrdersTwoToTen) {
  for (int order = 2; order <= 10; ++order) {
    SCOPED_TRACE(order);
    const auto direction = [](int n, int controls) {
      NurbsDirection d{controls, n, {}, 0, 0};
      for (int k = 0; k < controls + n; ++k)
        d.knots.push_back(static_cast<float>(k + 0.3 * noise(static_cast<uint32_t>(k))));
      d.min = d.knots[static_cast<size_t>(n - 1)];
      d.max = d.knots[static_cast<size_t>(controls)];
      return d;
    };
    const NurbsDirection u = direction(order, order + 1), v = direction(12 - order, 13 - order);
    const std::vector<glm::dvec4> controls = randomControls(u.controls, v.controls, true);
    Problems problems;
    const PrimPtr prim = makeNuPatch(u, v, {}, {asParam(controls, true)}, problems);
    ASSERT_EQ(prim->patchCount(), 4u);
    for (uint32_t patch = 0; patch < 4; ++patch)
      expectDefinition(
          *prim, patch,
          [&](double s, double t) {
            const size_t i0 = static_cast<size_t>(u.order - 1) + patch % 2,
                         j0 = static_cast<size_t>(v.order - 1) + patch / 2;
            // A step over the end of a span belongs to its neighbour: within 1e-5 their difference shows in no first
            // derivative.
            const double x = glm::mix(double{u.knots[i0]}, double{u.knots[i0 + 1]}, std::clamp(s, 1e-9, 1 - 1e-9)),
                         y = glm::mix(double{v.knots[j0]}, double{v.knots[j0 + 1]}, std::clamp(t, 1e-9, 1 - 1e-9));
            const std::vector<double> byU = coxDeBoor(u.knots, u.order, x), byV = coxDeBoor(v.knots, v.order, y);
            glm::dvec4 sum(0);
            for (size_t k = 0; k < controls.size(); ++k)
              sum += byU[k % static_cast<size_t>(u.controls)] * byV[k / static_cast<size_t>(u.controls)] * controls[k];
            return glm::dvec3(sum) / sum.w;
          },
          250);
  }
}

TEST(Definition, IsFollowedByFlatPolygons) {
  Problems none;
  const glm::dvec3 a(0, 0, 1), b(2, 0.5, 2), c(2.5, 2, 2.25), d(0.5, 1.5, 1.25);  // a + c = b + d: flat
  const auto corners = [](const std::vector<glm::dvec3>& p) {
    std::vector<float> out;
    for (const glm::dvec3& q : p)
      out.insert(out.end(), {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)});
    return positions(out);
  };
  expectDefinition(
      *makePolygons({4}, {0, 1, 2, 3}, {corners({a, b, c, d})}, none), 0,
      [&](double u, double v) { return glm::mix(glm::mix(a, b, u), glm::mix(d, c, u), v); }, 1000);
}

/// A circle whose start and sense are free, as its first point and that of a quarter say.
struct Circle {
  double start, sense;
  Circle(const vec2& first, const vec2& quarter)
      : start(std::atan2(double{first.y}, double{first.x})),
        sense(std::sin(std::atan2(double{quarter.y}, double{quarter.x}) - start) > 0 ? 1 : -1) {}
  glm::dvec2 at(double t) const {
    return {std::cos(start + sense * 2 * M_PI * t), std::sin(start + sense * 2 * M_PI * t)};
  }
};

TEST(Definition, IsFollowedByPointsThatAreDisks) {
  Problems none;
  const PrimPtr disk =
      makePoints({positions({1, 2, 3}), floats("constantwidth", Storage::Constant, ValueType::Float, {3}),
                  floats("N", Storage::Vertex, ValueType::Normal, {0, 0, 1})},
                 none);
  // The square -1..1 onto the disk by P. Nowell's elliptical mapping; how it is turned is free.
  const glm::dvec3 centre(1, 2, 3), right = glm::dvec3(sampleAt(*disk, 0, 1, 0.5f).p) - centre,
                                    up = glm::dvec3(sampleAt(*disk, 0, 0.5f, 1).p) - centre;
  EXPECT_NEAR(glm::length(right), 1.5, 1e-6);
  EXPECT_NEAR(glm::length(glm::cross(right, up)), 1.5 * 1.5, 1e-5);
  expectDefinition(
      *disk, 0,
      [&](double u, double v) {
        const double a = 2 * u - 1, b = 2 * v - 1;
        return centre + a * std::sqrt(1 - b * b / 2) * right + b * std::sqrt(1 - a * a / 2) * up;
      },
      1000);
}

TEST(Definition, IsFollowedByPointsThatAreSpheres) {
  Problems none;
  Param type = floats("type", Storage::Uniform, ValueType::String, {});
  type.strings = {"sphere"};
  const PrimPtr ball =
      makePoints({positions({1, 2, 3}), floats("constantwidth", Storage::Constant, ValueType::Float, {3}), type}, none);
  const auto from = [&](float u) { return vec2(sampleAt(*ball, 0, u, 0.5f).p) - vec2(1, 2); };
  const Circle circle(from(0), from(0.25f));
  const double up = sampleAt(*ball, 0, 0, 1).p.z > 3 ? 1 : -1;
  expectDefinition(
      *ball, 0,
      [&](double u, double v) {
        const double phi = up * M_PI * (v - 0.5);
        return glm::dvec3(glm::dvec2(1, 2) + 1.5 * std::cos(phi) * circle.at(u), 3 + 1.5 * std::sin(phi));
      },
      1000);
}

TEST(Definition, IsFollowedByStraightCurves) {
  Problems none;
  const Param line = positions({1, 2, 0, 1, 2, 4}),
              wide = floats("constantwidth", Storage::Constant, ValueType::Float, {0.5f});
  const Param n = floats("N", Storage::Constant, ValueType::Normal, {0, 1, 0});
  const PrimPtr ribbon = makeCurves(false, bezierBasis(), {2}, false, {line, wide, n}, none);
  const double left = sampleAt(*ribbon, 0, 0, 0).p.x < 1 ? 1 : -1;
  expectDefinition(
      *ribbon, 0, [&](double u, double v) { return glm::dvec3(1 + left * 0.5 * (u - 0.5), 2, 4 * v); }, 1000);
  const PrimPtr tube = makeTubes(false, bezierBasis(), {2}, false, {line, wide}, none);
  const auto from = [&](float u) { return vec2(sampleAt(*tube, 0, u, 0).p) - vec2(1, 2); };
  const Circle circle(from(0), from(0.25f));
  expectDefinition(
      *tube, 0, [&](double u, double v) { return glm::dvec3(glm::dvec2(1, 2) + 0.25 * circle.at(u), 4 * v); }, 1000);
}

/// Volume within the diced surface, by the divergence theorem.
double dicedVolume(const Prim& prim, int side) {
  double volume = 0;
  for (uint32_t patch = 0; patch < prim.patchCount(); ++patch) {
    std::vector<float> u, v;
    for (int k = 0; k < (side + 1) * (side + 1); ++k) {
      u.push_back(static_cast<float>(k % (side + 1)) / side);
      v.push_back(static_cast<float>(k / (side + 1)) / side);
    }
    const std::vector<Sample> s = samplesAt(prim, patch, u, v);
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const int k = j * (side + 1) + i;
        const glm::dvec3 a = s[k].p, b = s[k + 1].p, c = s[k + side + 1].p, d = s[k + side + 2].p;
        volume += (glm::dot(a, glm::cross(b, c)) + glm::dot(b, glm::cross(d, c))) / 6;
      }
  }
  return std::abs(volume);
}

TEST(Definition, VolumesConvergeAtSecondOrder) {
  Problems none;
  const double h = std::sqrt(0.5);
  std::vector<float> pw;  // RISpec's circle revolved: the unit sphere
  for (const auto& [r, z, w] :
       {std::array{0.0, -1.0, 1.0}, {1.0, -1.0, h}, {1.0, 0.0, 1.0}, {1.0, 1.0, h}, {0.0, 1.0, 1.0}})
    for (const auto& [x, y, c] : {std::array{1.0, 0.0, 1.0},
                                  {1.0, 1.0, h},
                                  {0.0, 1.0, 1.0},
                                  {-1.0, 1.0, h},
                                  {-1.0, 0.0, 1.0},
                                  {-1.0, -1.0, h},
                                  {0.0, -1.0, 1.0},
                                  {1.0, -1.0, h},
                                  {1.0, 0.0, 1.0}})
      for (const double value : {x * r * w * c, y * r * w * c, z * w * c, w * c})
        pw.push_back(static_cast<float>(value));
  const PrimPtr nurbs =
      makeNuPatch({9, 3, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, 0, 4}, {5, 3, {0, 0, 0, 1, 1, 2, 2, 2}, 0, 2}, {},
                  {floats("Pw", Storage::Vertex, ValueType::HPoint, pw)}, none);
  for (const auto& [prim, volume] : {std::pair(makeSphere(2, -2, 2, 360, {}, none), 32 * M_PI / 3),
                                     {makeTorus(3, 1, 0, 360, 360, {}, none), 6 * M_PI * M_PI},
                                     {nurbs, 4 * M_PI / 3}}) {
    const double coarse = std::abs(dicedVolume(*prim, 8) - volume), fine = std::abs(dicedVolume(*prim, 32) - volume);
    EXPECT_NEAR(std::log2(coarse / fine) / 2, 2, 0.1);
    EXPECT_LT(fine, 0.02 * volume);
  }
}

}  // namespace
}  // namespace tomales

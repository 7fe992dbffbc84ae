#include "tests/unit/prim/support.h"

namespace tomales {
namespace {
using namespace test;

float bump(uint32_t i) { return 2 * unitFloat(hash32(i + 1234)) - 1; }

ParamList rationalControls(std::vector<float> pw) {
  return {floats("Pw", Storage::Vertex, ValueType::HPoint, std::move(pw))};
}

/// A bumpy sheet with weights between 0.5 and 1.5.
std::vector<float> randomControls(int nu, int nv) {
  std::vector<float> pw;
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const uint32_t k = static_cast<uint32_t>(4 * (j * nu + i));
      const float w = 1 + 0.5f * bump(k);
      pw.insert(pw.end(), {w * (i + 0.3f * bump(k + 1)), w * (j + 0.3f * bump(k + 2)), w * bump(k + 3), w});
    }
  return pw;
}

struct Surface {
  NurbsDirection u, v;
  std::vector<float> pw;
  TrimLoops trim{};
  PrimPtr make(ParamList more = {}) const {
    Problems problems;
    ParamList params = rationalControls(pw);
    params.insert(params.end(), more.begin(), more.end());
    const PrimPtr prim = makeNuPatch(u, v, trim, params, problems);
    EXPECT_TRUE(problems.empty());
    return prim;
  }
};

std::vector<Surface> manySurfaces() {
  const NurbsDirection clamped{5, 4, {0, 0, 0, 0, 0.3f, 1, 1, 1, 1}, 0, 1}, open{5, 3, {0, 1, 2, 4, 5, 6, 9, 9}, 2, 5},
      straight{3, 2, {0, 0, 1, 3, 3}, 0, 3}, twice{6, 4, {-1, -1, -1, -1, 0, 0, 2, 2, 2, 2}, -1, 2},
      cut{5, 4, {0, 1, 2, 3, 4, 5, 6, 7, 8}, 3.5f, 4.75f},
      high{9, 8, {0, 0, 0, 0, 0, 0, 0, 0, 2, 3, 3, 3, 3, 3, 3, 3, 3}, 0, 3};
  std::vector<Surface> out;
  for (const auto& [u, v] :
       {std::pair(clamped, open), {straight, twice}, {cut, clamped}, {high, straight}, {twice, cut}})
    out.push_back({u, v, randomControls(u.controls, v.controls)});
  return out;
}

/// The Cox-de Boor definition, with 0/0 = 0.
double basis(const std::vector<float>& knots, size_t i, int order, double t, bool atEnd) {
  if (order == 1) return (knots[i] <= t && t < knots[i + 1]) || (atEnd && knots[i] < t && t == knots[i + 1]);
  const auto part = [&](double numerator, double length, size_t k) {
    return length > 0 ? numerator / length * basis(knots, k, order - 1, t, atEnd) : 0.0;
  };
  const size_t n = static_cast<size_t>(order);
  return part(t - knots[i], static_cast<double>(knots[i + n - 1]) - knots[i], i) +
         part(knots[i + n] - t, static_cast<double>(knots[i + n]) - knots[i + 1], i + 1);
}

glm::dvec3 defined(const Surface& s, double u, double v) {
  glm::dvec4 sum(0);
  for (int j = 0; j < s.v.controls; ++j)
    for (int i = 0; i < s.u.controls; ++i) {
      const float* h = &s.pw[static_cast<size_t>(4 * (j * s.u.controls + i))];
      sum += basis(s.u.knots, static_cast<size_t>(i), s.u.order, u, u == s.u.max) *
             basis(s.v.knots, static_cast<size_t>(j), s.v.order, v, v == s.v.max) * glm::dvec4(h[0], h[1], h[2], h[3]);
    }
  return glm::dvec3(sum) / sum.w;
}

TEST(NuPatch, PointsAreThoseOfTheCoxDeBoorDefinition) {
  for (const Surface& s : manySurfaces()) {
    const PrimPtr prim = s.make();
    for (uint32_t k = 0; k < 1000; ++k) {
      const uint32_t patch = k % prim->patchCount();
      const float u = k < 20 ? static_cast<float>(k & 1) : unitFloat(hashCombine(k, 1u)),
                  v = unitFloat(hashCombine(k, 2u));
      float su, sv;
      prim->surfaceParameters(patch, 1, &u, &v, &su, &sv);
      if (su >= 1 && u < 1) continue;  // rounded onto the end
      const glm::dvec3 expected = defined(s, s.u.min + static_cast<double>(su) * (s.u.max - s.u.min),
                                          s.v.min + static_cast<double>(sv) * (s.v.max - s.v.min));
      EXPECT_LT(glm::length(glm::dvec3(sampleAt(*prim, patch, u, v).p) - expected), 1e-5 * (1 + glm::length(expected)));
    }
  }
}

TEST(NuPatch, DerivativesAgreeWithFiniteDifferences) {
  for (const Surface& s : manySurfaces()) {
    const PrimPtr prim = s.make();
    expectDerivativesOfPositions(*prim, 1e-3f);
    const Sample at = sampleAt(*prim, 0, 0.4f, 0.6f);
    constexpr double h = 1e-4;  // of the definition, in double precision
    const float u = 0.4f, v = 0.6f, u1 = 1;
    float su, sv, end, ignored;
    prim->surfaceParameters(0, 1, &u, &v, &su, &sv);
    prim->surfaceParameters(0, 1, &u1, &v, &end, &ignored);
    const double range = s.u.max - s.u.min, x = s.u.min + su * range, y = s.v.min + sv * (s.v.max - s.v.min);
    const glm::dvec3 byKnot = (defined(s, x + h, y) - defined(s, x - h, y)) / (2 * h);
    const glm::dvec3 expected = byKnot * (static_cast<double>(end) * range);
    EXPECT_LT(glm::length(glm::dvec3(at.du) - expected), 1e-4 * (1 + glm::length(expected)));
  }
}

TEST(NuPatch, BoundsContainTheSurfaceAndAreTight) {
  for (const Surface& s : manySurfaces()) {
    expectBoundsContainTheSurface(*s.make());
    expectSoundEverywhere(*s.make());
  }
  const PrimPtr prim = manySurfaces()[0].make();
  EXPECT_LT(glm::length(prim->bound(0, {0.4f, 0.41f, 0.6f, 0.61f}).size()),
            0.05f * glm::length(prim->bound(0, {}).size()));
}

TEST(NuPatch, PatchesThatShareAnEdgeHaveTheSameBitsThere) {
  int joined = 0;
  for (const Surface& s : manySurfaces()) {
    const PrimPtr prim = s.make();
    for (uint32_t patch = 0; patch + 1 < prim->patchCount(); ++patch) {
      if (prim->info(patch).openEdges & kEdgeU1) continue;
      ++joined;
      for (float t : {0.0f, 0.123f, 0.7f, 1.0f})
        EXPECT_EQ(sampleAt(*prim, patch, 1, t).p, sampleAt(*prim, patch + 1, 0, t).p);
    }
  }
  EXPECT_GT(joined, 5);
}

/// RISpec's circle: nine controls of order 3.
Surface revolved(const std::vector<vec3>& meridian, NurbsDirection v) {  // (radius, height, weight)
  const float h = std::sqrt(0.5f);
  const vec3 circle[9] = {{1, 0, 1},   {1, 1, h},  {0, 1, 1},  {-1, 1, h}, {-1, 0, 1},
                          {-1, -1, h}, {0, -1, 1}, {1, -1, h}, {1, 0, 1}};
  Surface s{{9, 3, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, 0, 4}, std::move(v), {}};
  for (const vec3& m : meridian)
    for (const vec3& c : circle) {
      const float w = c.z * m.z;
      s.pw.insert(s.pw.end(), {c.x * m.x * w, c.y * m.x * w, m.y * w, w});
    }
  return s;
}

Surface sphere() {
  const float h = std::sqrt(0.5f);
  return revolved({{0, -1, 1}, {1, -1, h}, {1, 0, 1}, {1, 1, h}, {0, 1, 1}}, {5, 3, {0, 0, 0, 1, 1, 2, 2, 2}, 0, 2});
}

TEST(NuPatch, ASphereIsExact) {
  const PrimPtr prim = sphere().make();
  ASSERT_EQ(prim->patchCount(), 8u);
  for (uint32_t k = 0; k < 1000; ++k) {
    const Sample s = sampleAt(*prim, k % 8, unitFloat(hashCombine(k, 1u)), unitFloat(hashCombine(k, 2u)));
    EXPECT_NEAR(glm::length(s.p), 1, 1e-6);
    EXPECT_GT(dot(glm::normalize(s.n), s.p), 0.99999f);
  }
  EXPECT_NEAR(dicedArea(*prim, 64), 4 * M_PI, 5e-3);
}

TEST(NuPatch, ASphereIsClosedAndHasNormalsAtItsPoles) {
  const PrimPtr prim = sphere().make();
  for (uint32_t patch = 0; patch < 8; ++patch) EXPECT_EQ(prim->info(patch).openEdges, 0) << patch;
  EXPECT_GT(glm::normalize(sampleAt(*prim, 5, 0.3f, 1).n).z, 0.999f);
  EXPECT_LT(glm::normalize(sampleAt(*prim, 2, 0.3f, 0).n).z, -0.999f);
  expectSoundEverywhere(*prim);
}

TEST(NuPatch, ACylinderIsOpenAtItsEndsOnly) {
  const PrimPtr prim = revolved({{1, 0, 1}, {1, 2, 1}}, {2, 2, {0, 0, 1, 1}, 0, 1}).make();
  ASSERT_EQ(prim->patchCount(), 4u);
  for (uint32_t patch = 0; patch < 4; ++patch) EXPECT_EQ(prim->info(patch).openEdges, kEdgeV0 | kEdgeV1);
}

TEST(NuPatch, PrimvarsFollowTheSegmentsTheirCornersAndTheControls) {
  // Segments along u: [0,1], the empty [1,1], [1,2].
  Surface s{{4, 2, {0, 0, 1, 1, 2, 2}, 0, 2}, {2, 2, {0, 0, 1, 1}, 0, 1}, {}};
  for (float y : {0.0f, 1.0f})
    for (float x : {0.0f, 1.0f, 1.0f, 2.0f}) s.pw.insert(s.pw.end(), {x, y, 0, 1});
  const PrimPtr prim = s.make({floats("k", Storage::Uniform, ValueType::Float, {5, 6, 7}),
                               floats("c", Storage::Varying, ValueType::Float, {0, 1, 2, 4, 0, 1, 2, 4}),
                               floats("e", Storage::Vertex, ValueType::Color,
                                      {0, 0, 0, 1, 2, 3, 1, 2, 3, 2, 4, 6, 0, 0, 0, 1, 2, 3, 1, 2, 3, 2, 4, 6})});
  ASSERT_EQ(prim->patchCount(), 2u);
  EXPECT_EQ(primvarAt(*prim, 0, 0, 0.5f, 0.5f)[0], 5);
  EXPECT_EQ(primvarAt(*prim, 1, 0, 0.5f, 0.5f)[0], 7);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 0, 1, 0.5f, 0.5f)[0], 0.5f);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 1, 1, 0.5f, 0.5f)[0], 3);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 1, 2, 0.5f, 0.5f)[1], 3);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 1, 2, 0.5f, 0.5f)[2], 4.5f);
}

TEST(NuPatch, AVertexVariableThatIsThePositionStaysThePosition) {
  const Surface s = manySurfaces()[0];
  std::vector<float> copy;
  for (size_t i = 0; i < s.pw.size(); i += 4)
    for (size_t k = 0; k < 3; ++k) copy.push_back(s.pw[i + k] / s.pw[i + 3]);
  const PrimPtr prim = s.make({floats("where", Storage::Vertex, ValueType::Point, copy)});
  for (float t : {0.0f, 0.3f, 0.9f}) {
    const std::vector<float> w = primvarAt(*prim, 1, 0, t, 0.4f);
    EXPECT_LT(glm::length(vec3(w[0], w[1], w[2]) - sampleAt(*prim, 1, t, 0.4f).p), 1e-5f);
  }
}

TEST(NuPatch, ARangeWithinASegmentKeepsTheSegmentsCornerValues) {
  Surface s{
      {2, 2, {0, 0, 1, 1}, 0.25f, 0.75f}, {2, 2, {0, 0, 1, 1}, 0, 1}, {0, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1, 1, 1, 0, 1}};
  const PrimPtr prim = s.make({floats("c", Storage::Varying, ValueType::Float, {0, 1, 0, 1})});
  EXPECT_FLOAT_EQ(sampleAt(*prim, 0, 0, 0.5f).p.x, 0.25f);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 0, 0, 1, 0.5f)[0], 0.75f);
}

TEST(NastyNuPatch, WrongInputThrowsASentence) {
  const NurbsDirection good{2, 2, {0, 0, 1, 1}, 0, 1};
  const ParamList square = {positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0})};
  Problems problems;
  const auto errorWith = [&](const NurbsDirection& u, const ParamList& params) {
    return errorOf([&] { makeNuPatch(u, good, {}, params, problems); });
  };
  EXPECT_EQ(errorWith(good, square), "");
  EXPECT_EQ(errorWith({2, 2, {0, 0, 1}, 0, 1}, square),
            "along u, there are 3 knots where 2 controls of order 2 need 4");
  EXPECT_EQ(errorWith({2, 2, {0, 1, 0, 1}, 0, 1}, square), "along u, knot 2 is less than the one before");
  EXPECT_NE(errorWith({2, 2, {0, NAN, 1, 1}, 0, 1}, square), "");
  EXPECT_NE(errorWith({2, 2, {0, 0, 0, 0}, 0, 1}, square), "");
  EXPECT_NE(errorWith({2, 2, {0, 0, 1, 1}, 1, 0}, square), "");
  EXPECT_NE(errorWith({2, 2, {0, 0, 1, 1}, 0, NAN}, square), "");
  EXPECT_NE(errorWith({2, 3, {0, 0, 0, 1, 1}, 0, 1}, square), "");
  EXPECT_NE(errorWith({2, 0, {0, 0}, 0, 1}, square), "");
  EXPECT_NE(errorWith({-2, 2, {}, 0, 1}, square), "");
  EXPECT_NE(errorWith(good, {}), "");
  EXPECT_NE(errorWith(good, {positions({0, 0, 0})}), "");
  EXPECT_EQ(errorWith(good, rationalControls({0, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1, -1, -1, 0, -1})),
            "its weights are not positive everywhere");
  EXPECT_NE(errorWith(good, rationalControls({0, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1, -1, -1, 0, 0})), "");
}

TEST(NastyNuPatch, OrdersUpTo32AreDrawn) {
  const NurbsDirection v{2, 2, {0, 0, 1, 1}, 0, 1};
  Problems problems;
  const auto error = [&](int order) {
    NurbsDirection u{order, order, std::vector<float>(static_cast<size_t>(order), 0.0f), 0, 1};
    u.knots.resize(static_cast<size_t>(2 * order), 1.0f);
    std::vector<float> p;  // even controls on a line give an even line, whatever the order
    for (const float y : {0.0f, 1.0f})
      for (int i = 0; i < order; ++i) p.insert(p.end(), {static_cast<float>(i) / static_cast<float>(order - 1), y, 0});
    return errorOf([&] {
      const PrimPtr prim = makeNuPatch(u, v, {}, {positions(p)}, problems);
      EXPECT_LT(glm::length(sampleAt(*prim, 0, 0.3f, 0.6f).p - vec3(0.3f, 0.6f, 0)), 1e-6f) << order;
    });
  };
  EXPECT_EQ(error(2), "");
  EXPECT_EQ(error(32), "");
  EXPECT_EQ(error(33), "along u, the order is 33; it can be 2 to 32");
}

TEST(NastyNuPatch, AJumpAtAFullKnotIsOpenAndARangeTooLongIsCut) {
  const NurbsDirection jump{4, 2, {0, 0, 1, 1, 2, 2}, 0, 9}, v{2, 2, {0, 0, 1, 1}, 0, 1};
  Problems problems;
  const PrimPtr prim = makeNuPatch(
      jump, v, {}, {positions({0, 0, 0, 1, 0, 0, 5, 0, 0, 6, 0, 0, 0, 1, 0, 1, 1, 0, 5, 1, 0, 6, 1, 0})}, problems);
  EXPECT_EQ(problems.size(), 1u);
  ASSERT_EQ(prim->patchCount(), 2u);
  EXPECT_EQ(prim->info(0).openEdges, kAllEdges);
  EXPECT_EQ(sampleAt(*prim, 0, 1, 0.5f).p.x, 1);
  EXPECT_EQ(sampleAt(*prim, 1, 0, 0.5f).p.x, 5);
}

TEST(NuPatch, VaryingValuesOfManyPointsAreThoseOfEach) {
  for (const Surface& surface : manySurfaces()) {
    const auto corners = [](const NurbsDirection& d) { return d.controls - d.order + 2; };
    const int count = corners(surface.u) * corners(surface.v);
    std::vector<float> values;
    for (int i = 0; i < count; ++i) values.push_back(bump(static_cast<uint32_t>(i) + 77));
    const PrimPtr prim = surface.make({floats("heat", Storage::Varying, ValueType::Float, values)});
    const int index = static_cast<int>(prim->primvars().size()) - 1;
    const float u[] = {0.1f, 0.8f, 0.4f}, v[] = {0.9f, 0.2f, 0.5f};
    for (uint32_t patch = 0; patch < prim->patchCount(); ++patch) {
      float together[3];
      prim->interpolate(patch, index, 3, u, v, together, 1);
      for (int i = 0; i < 3; ++i) EXPECT_EQ(together[i], primvarAt(*prim, patch, index, u[i], v[i])[0]) << i;
    }
  }
}

}  // namespace
}  // namespace tomales

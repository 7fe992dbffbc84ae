#include "reyes/base/parallel.h"
#include "reyes/prim/subdivision_input.h"
#include "tests/unit/prim/subdivision.h"

namespace tomales {
namespace {
using namespace test;

Mesh sharpCube() {
  Mesh mesh = cube();
  return mesh.tag("crease", {0, 1, 2, 3, 0}, {10})
      .tag("crease", {4, 5, 6, 7, 4}, {10})
      .tag("crease", {0, 4}, {10})
      .tag("crease", {1, 5}, {10})
      .tag("crease", {2, 6}, {10})
      .tag("crease", {3, 7}, {10});
}
/// n x n quads over [0, n]^2, wavy.
Mesh sheet(int n) {
  Mesh mesh;
  std::vector<float> p;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      p.insert(p.end(), {static_cast<float>(i), static_cast<float>(j), 2 * unitFloat(hashCombine(i, j))});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      mesh.counts.push_back(4);
      mesh.vertices.insert(mesh.vertices.end(), {a, a + 1, a + n + 2, a + n + 1});
    }
  mesh.params = {positions(p)};
  return mesh;
}
Mesh tetrahedron() {
  return {{3, 3, 3, 3}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}, {positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1})}, {}};
}

TEST(SubdivisionMesh, LimitOfACubesCornerIsCatmullClarks) {
  // Halstead et al. 1993: (n^2 V + 4 sum E + sum F) / (n (n + 5)) with neighbours E across edges and F across
  // faces.
  const vec3 v(1, 1, 1), edges = vec3(-1, 1, 1) + vec3(1, -1, 1) + vec3(1, 1, -1);
  const vec3 faces = vec3(-1, -1, 1) + vec3(-1, 1, -1) + vec3(1, -1, -1);
  const vec3 limit = (9.0f * v + 4.0f * edges + faces) / 24.0f;
  const PrimPtr prim = cube().make();
  ASSERT_EQ(prim->patchCount(), 6u);
  EXPECT_LT(glm::length(sampleAt(*prim, 1, 1, 1).p - limit), 1e-6f);  // face 4 5 6 7: vertex 6 is (1,1,1)
  EXPECT_LT(glm::length(sampleAt(*prim, 4, 0, 1).p - limit), 1e-6f);  // face 2 3 7 6
}

TEST(SubdivisionMesh, NormalsOfACubePointOutward) {
  const PrimPtr prim = cube().make();
  for (uint32_t patch = 0; patch < 6; ++patch)
    for (float u : {0.0f, 0.5f, 1.0f})
      for (float v : {0.0f, 0.5f, 1.0f}) {
        const Sample s = sampleAt(*prim, patch, u, v);
        EXPECT_GT(dot(glm::normalize(s.n), glm::normalize(s.p)), 0.9f);
      }
}

TEST(SubdivisionMesh, InfinitelySharpCreasesMakeItTheCube) {
  Mesh mesh = sharpCube();
  const PrimPtr prim = mesh.make();
  EXPECT_TRUE(mesh.problems.empty());
  EXPECT_NEAR(dicedArea(*prim, 4), 24, 1e-4);
  EXPECT_LT(glm::length(sampleAt(*prim, 1, 1, 1).p - vec3(1, 1, 1)), 1e-6f);
  expectSoundEverywhere(*prim);
}

TEST(SubdivisionMesh, SemiSharpCreasesLieBetweenSmoothAndSharp) {
  Mesh mesh = cube();
  const PrimPtr semi = mesh.tag("crease", {4, 5, 6, 7, 4}, {2, 2, 2, 2}).make();
  const float smooth = sampleAt(*cube().make(), 1, 0.5f, 0).p.z, sharp = sampleAt(*sharpCube().make(), 1, 0.5f, 0).p.z;
  const float between = sampleAt(*semi, 1, 0.5f, 0).p.z;
  EXPECT_GT(between, smooth + 0.01f);
  EXPECT_LT(between, sharp - 0.001f);
}

TEST(SubdivisionMesh, ACornerIsInterpolated) {
  Mesh mesh = cube();
  EXPECT_LT(glm::length(sampleAt(*mesh.tag("corner", {6}, {10}).make(), 1, 1, 1).p - vec3(1, 1, 1)), 1e-5f);
}

TEST(SubdivisionMesh, HolesVanishAndOpenTheirNeighbours) {
  Mesh mesh = cube();
  const PrimPtr prim = mesh.tag("hole", {1}).make();
  ASSERT_EQ(prim->patchCount(), 5u);
  int open = 0;
  for (uint32_t patch = 0; patch < 5; ++patch)
    for (int bit = 0; bit < 4; ++bit) open += prim->info(patch).openEdges >> bit & 1;
  EXPECT_EQ(open, 4);
  EXPECT_EQ(cube().make()->info(0).openEdges, 0);
}

TEST(SubdivisionMesh, BoundaryFacesNeedInterpolateBoundary) {
  EXPECT_EQ(sheet(4).make()->patchCount(), 4u);
  EXPECT_EQ(sheet(4).tag("interpolateboundary", {0}).make()->patchCount(), 4u);
  EXPECT_EQ(sheet(4).tag("interpolateboundary").make()->patchCount(), 16u);
  const PrimPtr corners = sheet(4).tag("interpolateboundary", {1}).make(),
                edges = sheet(4).tag("interpolateboundary", {2}).make();
  EXPECT_LT(glm::length(vec2(sampleAt(*corners, 0, 0, 0).p.x, sampleAt(*corners, 0, 0, 0).p.y)), 1e-6f);
  EXPECT_GT(sampleAt(*edges, 0, 0, 0).p.x, 0.1f);
  Mesh one = sheet(1);
  EXPECT_EQ(one.make()->patchCount(), 0u);
  EXPECT_EQ(one.problems.size(), 1u);
}

TEST(SubdivisionMesh, ARegularPatchIsTheUniformBSpline) {
  Problems problems;
  Mesh mesh = sheet(3);
  const PrimPtr limit = mesh.make(), spline = makeBicubicPatchMesh(4, false, bsplineBasis(), 4, false, bsplineBasis(),
                                                                   mesh.params, problems);
  ASSERT_EQ(limit->patchCount(), 1u);
  for (float u : {0.0f, 0.3f, 1.0f})
    for (float v : {0.0f, 0.6f, 1.0f}) {
      const Sample a = sampleAt(*limit, 0, u, v), b = sampleAt(*spline, 0, u, v);
      EXPECT_LT(glm::length(a.p - b.p) + glm::length(a.du - b.du) + glm::length(a.dv - b.dv), 2e-5f);
    }
}

TEST(SubdivisionMesh, PatchesMeetAtTheirEdges) {
  for (Mesh mesh : {cube(), tetrahedron(), sheet(3).tag("interpolateboundary", {1})}) {
    const PrimPtr prim = mesh.make();
    // Every point of a closed edge lies on another patch's edge too.
    std::vector<std::pair<uint32_t, vec3>> edge;
    for (uint32_t patch = 0; patch < prim->patchCount(); ++patch)
      for (int bit = 0; bit < 4; ++bit)
        for (float t : {0.25f, 0.5f, 0.75f})
          if (!(prim->info(patch).openEdges >> bit & 1))
            edge.emplace_back(patch, sampleAt(*prim, patch,
                                              bit == 0   ? 0
                                              : bit == 1 ? 1
                                                         : t,
                                              bit == 2   ? 0
                                              : bit == 3 ? 1
                                                         : t)
                                         .p);
    for (const auto& [patch, p] : edge) {
      float nearest = kInfinity;
      for (const auto& [other, q] : edge)
        if (other != patch) nearest = std::min(nearest, glm::length(p - q));
      EXPECT_LT(nearest, 1e-6f * (1 + glm::length(p)));
    }
  }
}

TEST(SubdivisionMesh, RegularFacesMeetTheirIrregularNeighboursSmoothly) {
  Mesh mesh = sheet(8);  // a crease inside, holes in the outline: regular, boundary and crease faces next to each other
  mesh.tag("interpolateboundary", {1}).tag("crease", {28, 29, 30, 31}, {10}).tag("corner", {48}, {3}).tag("hole", {57});
  const PrimPtr prim = mesh.make();
  EXPECT_TRUE(mesh.problems.empty());
  ASSERT_EQ(prim->patchCount(), 63u);
  for (uint32_t patch = 0; patch < 56; ++patch)
    for (float t : {0.0f, 0.3f, 0.8f, 1.0f}) {
      const uint32_t above = patch + 8 - (patch + 8 > 57);
      if (patch + 8 == 57) continue;
      EXPECT_LT(glm::length(sampleAt(*prim, patch, t, 1).p - sampleAt(*prim, above, t, 0).p), 5e-6f) << patch;
    }
  expectDerivativesOfPositions(*prim, 2e-2f);
  expectBoundsContainTheSurface(*prim, 63 * 50 * 8);
}

TEST(SubdivisionMesh, ThreadsThatShareItGetTheSameBits) {
  const PrimPtr prim = sheet(6).tag("interpolateboundary", {1}).tag("crease", {15, 16, 17}, {2.5f}).make();
  const PrimPtr twin = sheet(6).tag("interpolateboundary", {1}).tag("crease", {15, 16, 17}, {2.5f}).make();
  std::vector<vec3> together(36 * 20);
  parallelFor(together.size(), 1, [&](size_t begin, size_t) {
    together[begin] =
        sampleAt(*prim, static_cast<uint32_t>(begin % 36), 0.05f * static_cast<float>(begin / 36), 0.3f).p;
  });
  for (size_t i = 0; i < together.size(); ++i)
    EXPECT_EQ(together[i], sampleAt(*twin, static_cast<uint32_t>(i % 36), 0.05f * static_cast<float>(i / 36), 0.3f).p);
}

TEST(SubdivisionMesh, DerivativesAgreeWithFiniteDifferences) {
  expectDerivativesOfPositions(*cube().make(), 2e-2f);
  expectDerivativesOfPositions(*tetrahedron().make(), 2e-2f);
  expectDerivativesOfPositions(*sheet(5).make(), 2e-2f);
}

TEST(SubdivisionMesh, BoundsContainTheSurface) {
  for (Mesh mesh : {cube(), tetrahedron(), sharpCube(), sheet(4).tag("interpolateboundary", {1}),
                    cube().tag("crease", {4, 5, 6, 7, 4}, {3.3f}), tetrahedron().tag("corner", {0, 1}, {1.5f, 4})})
    expectBoundsContainTheSurface(*mesh.make());
}

TEST(SubdivisionMesh, BoundsOfSmallPiecesAreTight) {
  const PrimPtr prim = cube().make();
  EXPECT_LT(glm::length(prim->bound(0, {0.4f, 0.41f, 0.6f, 0.61f}).size()),
            0.05f * glm::length(prim->bound(0, {}).size()));
}

TEST(SubdivisionMesh, InterpolatesEveryStorage) {
  Mesh mesh = cube();
  std::vector<float> y, faceVarying;
  for (size_t i = 0; i < 8; ++i) y.push_back(kCube[3 * i + 1]);
  for (int i = 0; i < 24; ++i) faceVarying.push_back(static_cast<float>(i));
  mesh.params.push_back(floats("y", Storage::Vertex, ValueType::Float, y));
  mesh.params.push_back(floats("k", Storage::Varying, ValueType::Float, y));
  mesh.params.push_back(floats("f", Storage::FaceVarying, ValueType::Float, faceVarying));
  mesh.params.push_back(floats("a", Storage::Uniform, ValueType::Float, {0, 1, 2, 3, 4, 5}));
  const PrimPtr prim = mesh.make();
  EXPECT_TRUE(mesh.problems.empty());
  EXPECT_NEAR(primvarAt(*prim, 1, 0, 0.2f, 0.9f)[0], sampleAt(*prim, 1, 0.2f, 0.9f).p.y, 1e-6);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 1, 1, 0.5f, 0.25f)[0], -0.5f);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 1, 2, 0, 1)[0], 7);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 1, 2, 0.5f, 0)[0], 4.5f);
  EXPECT_EQ(primvarAt(*prim, 5, 3, 0.5f, 0)[0], 5);
}

/// n quadrilaterals around a vertex at the origin, closed by nothing.
Mesh fan(int n) {
  Mesh mesh;
  std::vector<float> p = {0, 0, 0};
  for (int k = 0; k < 2 * n; ++k) {
    const float angle = kPi * static_cast<float>(k) / static_cast<float>(n);
    p.insert(p.end(), {std::cos(angle), std::sin(angle), static_cast<float>(k % 3)});
  }
  for (int k = 0; k < n; ++k) {
    mesh.counts.push_back(4);
    mesh.vertices.insert(mesh.vertices.end(), {0, 1 + 2 * k, 2 + 2 * k, 1 + (2 * k + 2) % (2 * n)});
  }
  mesh.params = {positions(p)};
  return mesh.tag("interpolateboundary", {1});
}

TEST(SubdivisionMesh, PrimvarsOfFacesInACrowdFollowTheSurface) {
  // The heights of the vertices as variables: they are where the surface is.
  Mesh mesh = fan(80).tag("facevaryinginterpolateboundary", {1});
  const std::vector<float> p = mesh.params[0].floats;
  std::vector<float> heights, ofFaces;
  for (size_t k = 2; k < p.size(); k += 3) heights.push_back(p[k]);
  for (const int v : mesh.vertices) ofFaces.push_back(heights[static_cast<size_t>(v)]);
  mesh.params.push_back(floats("a", Storage::Vertex, ValueType::Float, heights));
  mesh.params.push_back(floats("b", Storage::FaceVarying, ValueType::Float, ofFaces));
  mesh.params.push_back(floats("c", Storage::Varying, ValueType::Float, heights));
  const PrimPtr prim = mesh.make();
  for (uint32_t patch = 0; patch < prim->patchCount(); patch += 7)
    for (const float u : {0.0f, 0.3f, 1.0f})
      for (const float v : {0.1f, 0.9f}) {
        const float z = sampleAt(*prim, patch, u, v).p.z;
        EXPECT_NEAR(primvarAt(*prim, patch, 0, u, v)[0], z, 1e-5f);
        EXPECT_NEAR(primvarAt(*prim, patch, 1, u, v)[0], z, 1e-5f);
        const int* corner = &mesh.vertices[patch * size_t{4}];
        const auto at = [&](int k) { return heights[static_cast<size_t>(corner[k])]; };
        EXPECT_NEAR(primvarAt(*prim, patch, 2, u, v)[0], lerp(lerp(at(0), at(1), u), lerp(at(3), at(2), u), v), 1e-5f);
      }
}

TEST(SubdivisionMesh, LinearFaceVaryingValuesInACrowdAreBlendedBetweenTheCornersOfEachFace) {
  Mesh mesh = fan(80).tag("facevaryinginterpolateboundary", {0});
  std::vector<float> colors;
  for (size_t k = 0; k < 3 * mesh.vertices.size(); ++k) colors.push_back(static_cast<float>(k * k % 17));
  mesh.params.push_back(floats("tint", Storage::FaceVarying, ValueType::Color, colors));
  const PrimPtr prim = mesh.make();
  for (uint32_t patch = 0; patch < prim->patchCount(); patch += 7)
    for (int c = 0; c < 3; ++c) {
      const auto at = [&](int corner) { return colors[12 * patch + static_cast<size_t>(3 * corner + c)]; };
      EXPECT_NEAR(primvarAt(*prim, patch, 0, 0.25f, 0.5f)[static_cast<size_t>(c)],
                  lerp(lerp(at(0), at(1), 0.25f), lerp(at(3), at(2), 0.25f), 0.5f), 1e-4f);
    }
}

// A face of this fan meets 2n + 10 corners of faces. Above 96 it has a table of its own, which takes much memory.
TEST(SubdivisionMesh, FacesAmongMoreThan96CornersAreACrowd) {
  const auto bytesOfFace = [](int n) { return fan(n).make()->bytes() / static_cast<size_t>(n); };
  EXPECT_LT(bytesOfFace(43), 1000u);
  EXPECT_GT(bytesOfFace(44), 5000u);
}

TEST(SubdivisionMesh, BoundsOfFacesInACrowdContainTheSurface) { expectBoundsContainTheSurface(*fan(80).make()); }

TEST(SubdivisionMesh, CrowdsBeyondMeasureAreDrawnAsTheCage) {
  Mesh mesh = fan(5000);
  const PrimPtr prim = mesh.make();
  ASSERT_EQ(mesh.problems.size(), 1u);
  EXPECT_NE(mesh.problems[0].find("vertex 0"), std::string::npos) << mesh.problems[0];
  EXPECT_EQ(sampleAt(*prim, 0, 1, 1).p.z, 1);
}

TEST(SubdivisionMesh, ACrowdOfMoreThan8192CornersIsBeyondMeasure) {
  const auto crowd = [](int triangles, int quadrilaterals) {
    std::vector<int> counts, vertices;
    for (int k = 0; k < triangles + quadrilaterals; ++k) {  // all around vertex 7
      counts.push_back(k < triangles ? 3 : 4);
      vertices.insert(vertices.end(), {7, 8 + k, 9 + k});
      if (k >= triangles) vertices.push_back(0);
    }
    return crowdBeyondMeasure(counts, vertices, static_cast<size_t>(triangles + quadrilaterals + 9));
  };
  EXPECT_FALSE(crowd(8192, 0));
  EXPECT_FALSE(crowd(0, 4096));
  ASSERT_TRUE(crowd(1, 4096));
  EXPECT_EQ(crowd(1, 4096)->vertex, 7);
  EXPECT_EQ(crowd(1, 4096)->corners, 8193u);
}

TEST(SubdivisionMesh, EveryHierarchicalEditIsNamed) {
  Mesh mesh = cube();
  mesh.tags = {{"vertexedit", "faceedit"}, {3, 1, 2, 2, 0, 1}, {0, 1, 2, 5, 3}, {0.5f}, {"P", "add", "hole"}};
  const PrimPtr prim = mesh.make();
  ASSERT_EQ(prim->patchCount(), 6u);
  ASSERT_EQ(mesh.problems.size(), 2u);
  EXPECT_EQ(mesh.problems[0].find("\"vertexedit\" [0 1 2] \"P\" \"add\": "), 0u) << mesh.problems[0];
  EXPECT_EQ(mesh.problems[1].find("\"faceedit\" [5 3] \"hole\": "), 0u) << mesh.problems[1];
}

TEST(SubdivisionMesh, BilinearSchemeIsTheCageItself) {
  Mesh mesh = cube();
  mesh.scheme = "bilinear";
  EXPECT_NEAR(dicedArea(*mesh.make(), 2), 24, 1e-5);
}

}  // namespace
}  // namespace tomales

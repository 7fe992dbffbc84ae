// The mesh around the surface of a field, and the search for the surface from it.
#include "reyes/prim/blobby_mesh.h"

#include <gtest/gtest.h>

namespace tomales {
namespace blobby_mesh {
namespace {

/// A ball whose surface has the radius 1/2.
BlobField ballAt(const dvec3& center) {
  BlobField field({{glm::dmat3(1), -center, dvec3(0), dvec3(0), 1}});
  field.addLeaf(0);
  return field;
}
const Box kBox{dvec3(-1), dvec3(1)};

TEST(BlobSurface, IsMetAlongALineWithinItsReachFromEitherSide) {
  const BlobField field = ballAt(dvec3(0));
  const auto met = [&](double from, double reach) { return meetSurface(field, {0, 0, from}, {0, 0, 1}, reach); };
  EXPECT_EQ(met(0.5, 1), 0);
  for (const double from : {0.1, 0.3, 0.45, 0.6, 0.8}) {
    const double way = 0.5 - from;
    ASSERT_TRUE(met(from, 1)) << from;
    EXPECT_NEAR(*met(from, 1), way, 1e-12) << from;
    EXPECT_TRUE(met(from, 1.01 * std::abs(way))) << from;
    EXPECT_FALSE(met(from, 0.99 * std::abs(way))) << from;
  }
}

TEST(BlobSurface, OfABallHasAMeshOfCellsOfAQuarterOfItsRadius) {
  const BlobField field = ballAt(dvec3(0));
  const BlobMesh mesh = contour(field, kBox);
  EXPECT_TRUE(mesh.complete);
  // Lines of the cells' corners along each axis, 1/4 apart: nine go through the ball.
  EXPECT_EQ(mesh.quads.size(), 3u * 9 * 2);
  for (const BlobVertex& v : mesh.vertices) {
    EXPECT_NEAR(glm::length(v.position), 0.5f, 1e-6f);
    EXPECT_LT(glm::length(v.outward - glm::normalize(v.position)), 1e-5f);
    EXPECT_EQ(v.reach, 2 * 0.25f);
  }
  for (const BlobQuad& quad : mesh.quads) {
    const auto at = [&](size_t k) { return mesh.vertices[quad.corners[k]].position; };
    EXPECT_GT(dot(cross(at(1) - at(0), at(2) - at(0)), at(0)), 0) << "it faces outward";
  }
}

TEST(BlobSurface, ThatMovesTakesItsMeshAlong) {
  const BlobField field = ballAt(dvec3(0));
  const dvec3 by(3, 1, -2);
  const BlobMesh mesh = contour(field, kBox), carried = carriedMesh(mesh, field, ballAt(by));
  ASSERT_EQ(carried.vertices.size(), mesh.vertices.size());
  for (size_t k = 0; k < mesh.vertices.size(); ++k) {
    EXPECT_LT(glm::length(carried.vertices[k].position - mesh.vertices[k].position - vec3(by)), 1e-5f);
    EXPECT_LT(glm::length(carried.vertices[k].outward - mesh.vertices[k].outward), 1e-5f);
    EXPECT_EQ(carried.vertices[k].reach, mesh.vertices[k].reach);
  }
}

TEST(BlobSurface, ThatVanishesLeavesItsMeshWithoutReach) {
  const BlobField field = ballAt(dvec3(0));
  BlobField faint = ballAt(dvec3(0));
  faint.addConstant(0.1);
  faint.addOperation(BlobOp::Multiply, std::array<uint32_t, 2>{0, 1});
  const BlobMesh mesh = contour(field, kBox), carried = carriedMesh(mesh, field, faint);
  for (size_t k = 0; k < mesh.vertices.size(); ++k) {
    EXPECT_EQ(carried.vertices[k].reach, 0);
    EXPECT_LT(glm::length(carried.vertices[k].position - mesh.vertices[k].position), 1e-6f);
  }
  EXPECT_TRUE(contour(faint, kBox).quads.empty());
}

}  // namespace
}  // namespace blobby_mesh
}  // namespace tomales

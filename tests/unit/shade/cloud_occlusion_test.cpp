// occlusion() and the like from the disks of a point cloud.
#include "tests/unit/shade/cloud_calls.h"

namespace tomales {
namespace {

class CloudOcclusion : public CloudCalls {};

TEST_F(CloudOcclusion, OcclusionOfAPointCloudNeedsNoRaysAndIsAskedForInWorldSpaceUnderTheMask) {
  surface("pointbased");
  scene.cameraFromWorld = Motion::still(mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1));
  system().setClouds(&clouds);
  const ShadedPoints out = shade(row());
  expectColor(out.color(1), {0.125f + 0.5f, 1 - 10, 2});
  expectColor(out.color(3), {-1, -1, -1});
  EXPECT_TRUE(services.asked.empty());
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(CloudOcclusion, DistancesOfAPointCloudAreThoseOfTheWorldAndWhatRaysAloneKnowIsTold) {
  surface("distant");
  scene.cameraFromWorld = Motion::still(mat4(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1));
  system().setClouds(&clouds);
  EXPECT_FLOAT_EQ(shade(row()).color(0).x, 100 * 4 + 10 * 0.25f + 6)
      << "8, 1/2 and exp(-3 d) in a camera of twice the size";
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_EQ(log.worst(), Severity::Missing);
}

TEST_F(CloudOcclusion, WithoutItsCloudNothingIsCoveredAndTheUserIsTold) {
  surface("pointbased", {text("file", "absent.ptc")});
  system().setClouds(&clouds);
  expectColor(shade(row()).color(0), {0, 0, 0});
  EXPECT_EQ(log.worst(), Severity::Missing);
}

TEST_F(CloudOcclusion, DisksThatAreTooLargeForTheirNearnessAreToldOfOnce) {
  surface("pointbased");
  system().setClouds(&clouds);
  clouds.shareOfLarge = 0.4f;
  shade(row());
  EXPECT_TRUE(log.entries().empty()) << "a few do not show";
  clouds.shareOfLarge = 0.6f;
  shade(row());
  shade(row());
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_EQ(log.entries()[0].code, "point-cloud-coarse");
  EXPECT_EQ(log.worst(), Severity::Warning);
}

TEST_F(CloudOcclusion, DisksAreSeenFromMicropolygonsOfTheirSizeAndFromHitsOfRaysOfNone) {
  surface("pointbased");
  system().setClouds(&clouds);
  shade(row());
  EXPECT_GT(clouds.radiusAsked, 0);
  ShadeContext hit;
  hit.kind = RayKind::Diffuse;
  shade(row(), hit);
  EXPECT_EQ(clouds.radiusAsked, 0);
}

TEST_F(CloudOcclusion, ListsSetWhatTheyName) {
  surface("listing");
  worldFromObject = Motion::still(mat4(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1));
  system().setClouds(&clouds);
  const ShadedPoints out = shade(row());
  expectColor(out.color(2), {9, 1 + 10, 2.5f});  // found at 2 of the world, 1 of the object
  ASSERT_EQ(clouds.baked.size(), 4u);
  EXPECT_FLOAT_EQ(clouds.baked[2].radius, 0.75f) << "1/2, thrice, in an object of twice the size";
}

}  // namespace
}  // namespace tomales

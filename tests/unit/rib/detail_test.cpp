// Detail and DetailRange (RISpec 3.2 section 4.2.8): which share of 0..1 each level gets. One unit is 50 pixels here.
#include "rib_test_tools.h"

namespace tomales {
namespace {

const std::string kFlat = "Format 100 100 1 ScreenWindow -1 1 -1 1 Projection \"orthographic\" ";
const std::string kRuler = "Detail [-0.5 0.5 -0.5 0.5 1 2] ";  // 2500 px2

/// The share of a sphere after these requests; an empty one if it is not drawn.
DetailShare shareAfter(const std::string& world, const std::string& before = kFlat) {
  const Reading r(before + inWorld(world + kSphere));
  return r.scene().objects.size() == 0 ? DetailShare{0, 0} : r.attributes(0).detail;
}

void expectShare(const DetailShare& share, float lo, float hi) {
  EXPECT_NEAR(share.lo, lo, 1e-5f);
  EXPECT_NEAR(share.hi, hi, 1e-5f);
}

TEST(Detail, ALevelIsThereBetweenItsLimitsAndInPartAtItsTransitions) {
  const auto share = [](const std::string& range) { return shareAfter(kRuler + "DetailRange [" + range + "] "); };
  expectShare(share("1000 2000 3000 4000"), 0, 1);
  expectShare(share("2000 2800 4000 5000"), 0.375f, 1);
  expectShare(share("0 0 2000 4000"), 0, 0.75f);
  expectShare(share("2600 2700 4000 5000"), 0, 0);
  expectShare(share("0 0 2000 2400"), 0, 0);
  expectShare(share("0 0 2000 1e38"), 0, 1);
  expectShare(share("2400 2400 2600 2600"), 0, 1);
}

TEST(Detail, LevelsThatMeetLeaveNoGapAndDoNotOverlap) {
  for (const char* limits : {"2000 4000", "1000 2600", "2400 2501"}) {
    const DetailShare coarse = shareAfter(kRuler + "DetailRange [0 0 " + limits + "] "),
                      fine = shareAfter(kRuler + "DetailRange [" + limits + " 1e38 1e38] ");
    EXPECT_EQ(coarse.lo, 0);
    EXPECT_NEAR(coarse.hi, fine.lo, 1e-6f);
    EXPECT_EQ(fine.hi, 1);
  }
}

TEST(Detail, TheRulerIsTheAreaOfTheBoxInTheSpaceWhereItStands) {
  const std::string range = "DetailRange [0 0 5000 15000] ";
  expectShare(shareAfter("Scale 2 2 1 " + kRuler + range), 0, 0.5f);
  expectShare(shareAfter("Translate 7 0 0 Detail [-2 2 -0.5 0.5 1 2] " + range), 0, 0.5f);
  expectShare(shareAfter(kRuler + range, kFlat + "RelativeDetail 4 "), 0, 0.5f);
  expectShare(shareAfter(kRuler + "DetailRange [0 0 0 1] ", kFlat + "RelativeDetail 0 "), 0, 1);
}

TEST(Detail, ABoxThatReachesTheEyeIsLargerThanAnyLimit) {
  const std::string eye = "Format 100 100 1 Projection \"perspective\" \"fov\" [90] Clipping 1 100 ";
  expectShare(shareAfter("Detail [-1 1 -1 1 0.9 2] DetailRange [0 0 1e9 2e9] ", eye), 0, 0);
  expectShare(shareAfter("Detail [-1 1 -1 1 1 2] DetailRange [0 0 5000 15000] ", eye), 0, 0.5f);
  expectShare(shareAfter("Detail [-1 1 -1 1 2 4] DetailRange [0 0 2000 3000] ", eye), 0, 0.5f);
}

TEST(Detail, LevelsWithinALevelDivideItsShare) {
  const std::string half = kRuler + "DetailRange [0 0 2000 3000] AttributeBegin ";
  expectShare(shareAfter(half), 0, 0.5f);
  expectShare(shareAfter(half + "Detail [0 0.5 0 1 1 2] DetailRange [1000 2000 1e38 1e38] "), 0.375f, 0.5f);
  expectShare(shareAfter(half + "AttributeEnd DetailRange [2000 4000 1e38 1e38] "), 0.75f, 1);
}

TEST(Detail, ARangeThatDoesNotIncreaseIsTold) {
  const Reading r(kFlat + inWorld(kRuler + "DetailRange [0 0 2000 3000] DetailRange [3 2 5000 6000]" + kSphere));
  EXPECT_EQ(r.codes(), "rib-attribute@2 ");
  expectShare(r.attributes(0).detail, 0, 0.5f);
}

}  // namespace
}  // namespace tomales

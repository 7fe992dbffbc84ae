// The field of a Blobby: its ranges, which decide where nothing needs to be looked for, and its gradients.
#include "reyes/prim/blobby_field.h"

#include <gtest/gtest.h>

#include <array>

#include "reyes/base/rng.h"
#include "reyes/prim/blobby_ground.h"

namespace tomales {
namespace blobby_field {
namespace {

double random(double least, double most, uint32_t i, uint32_t salt) {
  return least + (most - least) * static_cast<double>(unitFloat(hashCombine(i, salt)));
}
dvec3 randomIn(const dvec3& lo, const dvec3& hi, uint32_t i, uint32_t salt) {
  return {random(lo.x, hi.x, i, salt), random(lo.y, hi.y, i, salt + 100), random(lo.z, hi.z, i, salt + 200)};
}

/// Two leaves, a point and a segment, each sheared, and `op` of both and of a constant.
BlobField fieldOf(BlobOp op, uint32_t seed) {
  std::vector<BlobLeaf> leaves;
  for (uint32_t k = 0; k < 2; ++k) {
    const uint32_t name = hashCombine(seed, k);
    glm::dmat3 axes(1);
    for (int c = 0; c < 3; ++c) axes[c] += randomIn(dvec3(-0.4), dvec3(0.4), name, 10 + static_cast<uint32_t>(c));
    const dvec3 from = randomIn(dvec3(-0.3), dvec3(0.3), name, 20);
    const dvec3 to = k == 0 ? from : randomIn(dvec3(-0.8), dvec3(0.8), name, 30);
    leaves.push_back({axes, randomIn(dvec3(-0.2), dvec3(0.2), name, 40), from, to, random(0.6, 1.4, name, 50)});
  }
  BlobField field(leaves);
  field.addLeaf(0);
  field.addLeaf(1);
  field.addConstant(0.3);
  field.addOperation(op, std::array<uint32_t, 3>{0, 1, 2});
  field.addOperation(BlobOp::Negate, std::array<uint32_t, 1>{3});
  field.addOperation(BlobOp::Add, std::array<uint32_t, 3>{4, 0, 1});
  return field;
}

/// A picture of a sloped ground with a step, 20 wide and 14 high, from 2 above z = 0. Nothing is seen beyond half its
/// width. With `perspective` it opens by a right angle, and what is above the camera is behind it.
BlobGround groundOf(bool perspective) {
  constexpr int kWide = 20, kHigh = 14;
  GroundPicture out{kWide, kHigh, {}, mat4(1.0f), mat4(1.0f)};
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kWide; ++x)
      out.depth.push_back(2 * x > kWide && 2 * y > kHigh ? INFINITY
                                                         : 2 + 0.02f * static_cast<float>(x) + (y < 4 ? 0.3f : 0.0f));
  out.cameraFromObject = mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 2, 1);
  out.texelFromObject = perspective ? mat4(10, 0, 0, 0, 0, -7, 0, 0, -10, -7, 0, -1, 20, 14, 0, 2)
                                    : mat4(10, 0, 0, 0, 0, -7, 0, 0, 0, 0, 1, 0, 10, 7, 0, 1);
  return {std::move(out), {0.5, 0.01, 0.15, 0.3}};
}

/// Calls check(box, name) for boxes of many sizes in the cube of this half width.
template <class Check>
void forBoxes(double reach, uint32_t count, const Check& check) {
  for (uint32_t i = 0; i < count; ++i) {
    const dvec3 center = randomIn(dvec3(-reach), dvec3(reach), i, 60),
                half = std::pow(10.0, random(-3, 0, i, 70)) * randomIn(dvec3(0.1), dvec3(1), i, 80);
    check(Box{center - half, center + half}, i);
  }
}

template <class Field>
void expectRangeHoldsTheField(const Field& field, const Box& box, uint32_t name) {
  const FieldRange range = field.over(box);
  for (uint32_t k = 0; k < 24; ++k) {
    const dvec3 p = k < 8 ? dvec3(k & 1 ? box.hi.x : box.lo.x, k & 2 ? box.hi.y : box.lo.y, k & 4 ? box.hi.z : box.lo.z)
                          : randomIn(box.lo, box.hi, hashCombine(name, k), 90);
    const double value = field.at(p).value;
    ASSERT_GE(value, range.lo - 1e-12 * (1 + std::abs(range.lo))) << name;
    ASSERT_LE(value, range.hi + 1e-12 * (1 + std::abs(range.hi))) << name;
  }
}

template <class Field>
void expectGradientOfDifferences(const Field& field, const dvec3& p) {
  constexpr double kStep = 1e-5;
  const FieldPoint here = field.at(p);
  for (int axis = 0; axis < 3; ++axis) {
    dvec3 step(0);
    step[axis] = kStep;
    const double ahead = (field.at(p + step).value - here.value) / kStep,
                 behind = (here.value - field.at(p - step).value) / kStep;
    if (std::abs(ahead - behind) > 1e-2 * (1 + std::abs(ahead))) continue;  // a crease, or an edge of the picture
    EXPECT_NEAR(here.gradient[axis], 0.5 * (ahead + behind), 2e-3 * (1 + std::abs(ahead)));
  }
}

constexpr BlobOp kOperations[] = {BlobOp::Add,     BlobOp::Multiply, BlobOp::Maximum,
                                  BlobOp::Minimum, BlobOp::Divide,   BlobOp::Subtract};

TEST(BlobField, TheRangeOverABoxHoldsItsValueEverywhereInTheBox) {
  for (const BlobOp op : kOperations)
    forBoxes(1.2, 150, [&](const Box& box, uint32_t i) { expectRangeHoldsTheField(fieldOf(op, i), box, i); });
}

TEST(BlobField, TheRangeOverASmallBoxIsNarrow) {
  for (const BlobOp op : {BlobOp::Add, BlobOp::Multiply, BlobOp::Maximum, BlobOp::Minimum, BlobOp::Subtract})
    for (uint32_t i = 0; i < 100; ++i) {
      const dvec3 p = randomIn(dvec3(-1), dvec3(1), i, 60);
      const FieldRange range = fieldOf(op, i).over({p - 1e-4, p + 1e-4});
      EXPECT_LT(range.hi - range.lo, 0.01);
    }
}

TEST(BlobField, TheGradientIsThatOfDifferences) {
  for (const BlobOp op : kOperations)
    for (uint32_t i = 0; i < 100; ++i)
      expectGradientOfDifferences(fieldOf(op, i), randomIn(dvec3(-0.7), dvec3(0.7), i, 60));
}

TEST(BlobField, WithinABoxTheShorterProgramHasTheSameBitsAndNoLeafThatDoesNotReachIt) {
  size_t dropped = 0;
  for (const BlobOp op : kOperations)
    forBoxes(1.2, 100, [&](const Box& box, uint32_t i) {
      const BlobField field = fieldOf(op, i), part = field.within(box);
      for (uint32_t k = 0; k < 10; ++k) {
        const dvec3 p = randomIn(box.lo, box.hi, hashCombine(i, k), 90);
        ASSERT_EQ(part.at(p).value, field.at(p).value);
      }
      dropped += part.leavesUsed() == 0;
    });
  EXPECT_GT(dropped, 30u);
}

TEST(BlobField, CarriesAPointAsItsLeavesMoveEachByItsWeight) {
  const auto field = [](BlobOp op, const dvec3& ball, const dvec3& from, const dvec3& to, double radius) {
    BlobField out({{glm::dmat3(1), -ball, dvec3(0), dvec3(0), radius}, {glm::dmat3(1), dvec3(0), from, to, radius}});
    out.addLeaf(0);
    out.addLeaf(1);
    out.addOperation(op, std::array<uint32_t, 2>{0, 1});
    return out;
  };
  const auto carried = [&](BlobOp op, const dvec3& p) {
    return field(op, {0, -0.3, 0}, {-1, 0.3, 0}, {3, 0.3, 0}, 1)
        .carried(p, field(op, {7, 0, 0}, {0, 5, 0}, {0, 5, 8}, 2));
  };
  // Twice as wide about its own line. A quarter of the way along the segment is z = 2 in the other.
  const dvec3 p(0, 0.1, 0.2), byBall(7, 0.8, 0.4), bySegment(0, 4.6, 2.4);
  const auto fall = [](double distance2) { return std::pow(1 - distance2, 3); };
  const double ball = fall(0.4 * 0.4 + 0.2 * 0.2), segment = fall(0.2 * 0.2 + 0.2 * 0.2);
  EXPECT_LT(glm::length(carried(BlobOp::Add, p) - (ball * byBall + segment * bySegment) / (ball + segment)), 1e-12);
  EXPECT_LT(glm::length(carried(BlobOp::Maximum, p) - bySegment), 1e-12);
  EXPECT_LT(glm::length(carried(BlobOp::Minimum, p) - byBall), 1e-12);
  EXPECT_EQ(carried(BlobOp::Add, {9, 9, 9}), dvec3(9, 9, 9)) << "no leaf is there";
}

TEST(BlobGround, TheRangeOverABoxHoldsItsForceEverywhereInTheBox) {
  for (const bool perspective : {false, true})
    forBoxes(2.3, 1500, [&](const Box& box, uint32_t i) { expectRangeHoldsTheField(groundOf(perspective), box, i); });
}

TEST(BlobGround, TheRangeOverASmallBoxAboveTheGroundIsNarrow) {
  for (const bool perspective : {false, true}) {
    const BlobGround ground = groundOf(perspective);
    for (uint32_t i = 0; i < 200; ++i) {
      const dvec3 p = randomIn({-0.8, -0.9, 0.1}, {-0.3, 0, 0.6}, i, 60);
      const FieldRange range = ground.over({p - 1e-4, p + 1e-4});
      EXPECT_LT(range.hi - range.lo, 0.4) << "one step of the picture is 0.02";
    }
    EXPECT_EQ(ground.over({dvec3(-0.5, -0.5, 0.9), dvec3(-0.4, -0.4, 1)}).hi, 0)
        << "it is higher than the force reaches";
    EXPECT_EQ(ground.over({dvec3(4, -0.5, 0), dvec3(5, 0.5, 1)}).lo, 0) << "it is beside the picture";
  }
}

TEST(BlobGround, TheRangeOverAPointAboveFlatGroundIsItsForceThere) {
  for (const bool perspective : {false, true}) {
    GroundPicture flat{4, 4, std::vector<float>(16, 2.0f), mat4(1.0f), mat4(1.0f)};
    flat.cameraFromObject = mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 2, 1);
    flat.texelFromObject = perspective ? mat4(2, 0, 0, 0, 0, -2, 0, 0, -2, -2, 0, -1, 4, 4, 0, 2)
                                       : mat4(2, 0, 0, 0, 0, -2, 0, 0, 0, 0, 1, 0, 2, 2, 0, 1);
    const BlobGround ground(std::move(flat), {0.5, 0.01, 0.15, 0.3});
    for (const double z : {0.02, 0.1, 0.2, 0.45, 0.6})
      for (const double x : {-0.8, 0.1, 0.7})
        for (const double y : {-0.7, -0.2, 0.8}) {
          const dvec3 p(x, y, z);
          const FieldRange range = ground.over({p, p});
          EXPECT_NEAR(range.lo, ground.at(p).value, 1e-9) << perspective << ' ' << z;
          EXPECT_NEAR(range.hi, ground.at(p).value, 1e-9) << perspective << ' ' << z;
        }
  }
}

TEST(BlobGround, TheRangeOverAWideBoxIsThatOfTheDepthsBelowIt) {
  for (const bool perspective : {false, true}) {
    const BlobGround ground = groundOf(perspective);
    for (uint32_t i = 0; i < 200; ++i) {
      const dvec3 half(random(0.05, 0.4, i, 71), random(0.05, 0.3, i, 72), 0.01),
          center(random(-0.45, 0, i, 73), random(-0.5, 0, i, 74), random(0.05, 0.2, i, 75));
      const FieldRange range = ground.over({center - half, center + half});
      // The ground is between 0.1 lower and 0.4 lower than z = 0 there, and the box is 0.02 high.
      EXPECT_LT(range.hi, 0.3 + 1e-9) << "no more than the bulge";
      EXPECT_GT(range.lo, -0.01 / (center.z - 0.01)) << "no more than the force at its lower side";
    }
  }
}

TEST(BlobGround, ReachesToEverySideOfThePicture) {
  const BlobGround ground = groundOf(false);
  // Places just within the picture, in the outermost halves of its texels, and boxes around them.
  for (const dvec3& p : {dvec3(-0.99, 0.3, 0), dvec3(0.99, 0.15, 0), dvec3(-0.3, 0.99, 0), dvec3(-0.3, -0.99, 0.1)}) {
    EXPECT_NE(ground.at(p).value, 0);
    for (uint32_t i = 0; i < 20; ++i) expectRangeHoldsTheField(ground, {p - 0.02 / (i + 1), p + 0.001}, i);
    for (uint32_t i = 0; i < 20; ++i) expectRangeHoldsTheField(ground, {p - 0.001, p + 0.02 / (i + 1)}, i);
  }
}

TEST(BlobGround, TheGradientIsThatOfDifferences) {
  for (const bool perspective : {false, true})
    for (uint32_t i = 0; i < 300; ++i)
      expectGradientOfDifferences(groundOf(perspective), randomIn({-0.9, -0.9, 0.01}, {0.9, 0.9, 0.6}, i, 60));
}

}  // namespace
}  // namespace blobby_field
}  // namespace tomales

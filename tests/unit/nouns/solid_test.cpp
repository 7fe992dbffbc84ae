// Solids along lines, against membership of points computed by the definition.
#include "reyes/solid.h"

#include <gtest/gtest.h>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

/// A reproducible source of random choices.
struct Dice {
  uint32_t name, count = 0;
  float unit() { return unitFloat(hashCombine(name, count++)); }
  int below(int n) { return std::min(static_cast<int>(unit() * static_cast<float>(n)), n - 1); }
};

/// A tree as the definition of RISpec reads it: recursive, and knowing nothing of Solid.
struct Tree {
  SolidOperation operation;
  int block;
  std::vector<Tree> operands;

  bool contains(const std::vector<bool>& insidePrimitive) const {
    const auto in = [&](const Tree& t) { return t.contains(insidePrimitive); };
    switch (operation) {
      case SolidOperation::Primitive:
        return insidePrimitive[static_cast<size_t>(block)];
      case SolidOperation::Union:
        return std::any_of(operands.begin(), operands.end(), in);
      case SolidOperation::Intersection:
        return !operands.empty() && std::all_of(operands.begin(), operands.end(), in);
      default:
        return !operands.empty() && in(operands[0]) && std::none_of(operands.begin() + 1, operands.end(), in);
    }
  }
};

Tree grow(Dice& dice, Solid& solid, int parent, int depth, std::vector<int>& primitives) {
  const auto operation = depth == 0 ? SolidOperation::Primitive : static_cast<SolidOperation>(dice.below(4));
  Tree tree{operation, solid.add(operation, parent), {}};
  if (operation == SolidOperation::Primitive)
    primitives.push_back(tree.block);
  else
    for (int n = dice.below(4); n > 0; --n)
      tree.operands.push_back(grow(dice, solid, tree.block, depth - 1, primitives));
  return tree;
}

TEST(Solid, OfRandomTreesHasItsBoundariesWhereMembershipChanges) {
  for (uint32_t name = 0; name < 3000; ++name) {
    Dice dice{name};
    Solid solid;
    std::vector<int> primitives;
    const Tree tree = grow(dice, solid, -1, 4, primitives);
    std::vector<SolidCrossing> crossings;
    // Each primitive is a union of intervals, some of which began before the line does.
    for (const int block : primitives)
      for (int n = dice.below(7); n > 0; --n) crossings.push_back({block, n % 2 == 0, dice.unit(), 0, 0});
    std::sort(crossings.begin(), crossings.end(), [](auto& a, auto& b) { return a.t < b.t; });
    SolidWalk walk(solid);
    std::vector<SolidBoundary> found;
    for (int again = 0; again < 2; ++again) {  // A walk leaves nothing behind for the next.
      walk.boundaries(crossings, found);
      size_t next = 0;
      for (size_t gap = 0; gap <= crossings.size(); ++gap) {
        std::vector<bool> inside(static_cast<size_t>(solid.blockCount()), false);
        for (size_t k = gap; k < crossings.size(); ++k) inside[static_cast<size_t>(crossings[k].block)].flip();
        const bool now = tree.contains(inside);
        if (gap == 0) {
          // Outside at the far end, so boundaries alternate back to here.
          ASSERT_EQ(found.size() % 2 == 1, now) << name;
          continue;
        }
        inside[static_cast<size_t>(crossings[gap - 1].block)].flip();
        const bool was = tree.contains(inside);
        if (was == now) continue;
        ASSERT_LT(next, found.size()) << name;
        ASSERT_EQ(found[next].crossing, gap - 1) << name;
        ASSERT_EQ(found[next].entering, now) << name;
        ++next;
      }
      ASSERT_EQ(next, found.size()) << name;
    }
  }
}

Solid twoOf(SolidOperation operation) {
  Solid s;
  s.add(operation, -1);
  s.add(SolidOperation::Primitive, 0);
  s.add(SolidOperation::Primitive, 0);
  return s;
}

size_t boundaryCount(const Solid& solid, const std::vector<SolidCrossing>& crossings) {
  std::vector<SolidBoundary> out;
  SolidWalk(solid).boundaries(crossings, out);
  return out.size();
}

TEST(Solid, LeavesNoSurfaceWhereTheSubtractedIsFlush) {
  const float slack = 1e-3f;
  // The subtracted ends where the first begins, a rounding early or late.
  for (const float off : {-slack, 0.0f, slack}) {
    std::vector<SolidCrossing> c = {
        {1, false, 1, 0, slack}, {2, false, 1 + off, 0, slack}, {2, true, 5, 0, slack}, {1, true, 9, 0, slack}};
    std::stable_sort(c.begin(), c.end(), [](auto& a, auto& b) { return a.t < b.t; });
    EXPECT_EQ(boundaryCount(twoOf(SolidOperation::Difference), c), 2U);
  }
  const std::vector<SolidCrossing> thin = {
      {1, false, 1, 0, slack}, {2, false, 1.1f, 0, slack}, {2, true, 5, 0, slack}, {1, true, 9, 0, slack}};
  EXPECT_EQ(boundaryCount(twoOf(SolidOperation::Difference), thin), 4U);
}

TEST(Solid, CountsOnceWhatTwoPiecesOfASurfaceBothShow) {
  const std::vector<SolidCrossing> overlap = {{1, false, 1, 0.2f, 0}, {1, false, 1.1f, 0.2f, 0}, {1, true, 2, 0.2f, 0}};
  EXPECT_EQ(boundaryCount(twoOf(SolidOperation::Union), overlap), 2U);
  const std::vector<SolidCrossing> thinSheet = {{1, false, 1, 0.2f, 0}, {1, true, 1.1f, 0.2f, 0}};
  EXPECT_EQ(boundaryCount(twoOf(SolidOperation::Union), thinSheet), 2U);
}

TEST(Solid, KnowsWhatIsSubtractedTwice) {
  Solid s;
  const int outer = s.add(SolidOperation::Difference, -1), a = s.add(SolidOperation::Primitive, outer);
  const int inner = s.add(SolidOperation::Difference, outer), b = s.add(SolidOperation::Primitive, inner);
  const int c = s.add(SolidOperation::Primitive, inner);
  EXPECT_FALSE(s.subtracted(a));
  EXPECT_TRUE(s.subtracted(b));
  EXPECT_FALSE(s.subtracted(c));
}

}  // namespace
}  // namespace tomales

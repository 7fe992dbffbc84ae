#include <gtest/gtest.h>

#include "references.h"

namespace tomales::compiler {
namespace {

constexpr int kBlocks = 5, kPoints = kBlocks * kBlock;

/// Slopes are held against differences of noise (slopes_test.cpp).
bool hasReference(Op op) { return op != Op::Slope3F && op != Op::Slope3T; }

class EveryKernel : public testing::TestWithParam<Entry> {
 protected:
  const Entry entry = GetParam();
  Numbers numbers{static_cast<uint32_t>(entry.op) + 1};

  Values random(int floats, bool varying, bool tame) {
    Values v(floats, kBlocks, varying);
    for (int c = 0; c < floats; ++c) {
      const float first = tame ? numbers.within(-2, 2) : numbers.any();
      for (int i = 0; i < kPoints; ++i) v.at(c, i) = !varying ? first : tame ? numbers.within(-2, 2) : numbers.any();
    }
    return v;
  }
  std::vector<Values> arguments(uint32_t uniform, bool tame) {
    std::vector<Values> all;
    for (size_t k = 0; k < entry.takes.size(); ++k)
      all.push_back(random(floatsOf(entry.takes[k]), !(uniform >> k & 1), tame));
    return all;
  }
  void expectReference(std::vector<Values>& in, Values& out, const std::string& what) {
    const Reference& reference = references().at(entry.op);
    for (int i = 0; i < kPoints; ++i) {
      std::vector<float> flat;
      for (Values& v : in)
        for (int c = 0; c < v.floats; ++c) flat.push_back(v.at(c, i));
      float wanted[16];
      reference.of(flat.data(), wanted);
      for (int c = 0; c < out.floats; ++c) {
        const float got = out.at(c, i);
        const bool same = reference.ulps == 0 && got == got ? std::memcmp(&got, &wanted[c], sizeof got) == 0
                                                            : ulpsBetween(got, wanted[c]) <= reference.ulps;
        if (same) continue;
        std::string values;
        for (float f : flat) values += " " + testing::PrintToString(f);
        FAIL() << entry.name << " " << what << ", component " << c << " of" << values << ": " << got << ", not "
               << wanted[c] << " (" << ulpsBetween(got, wanted[c]) << " ulps)";
      }
    }
  }
};

TEST_P(EveryKernel, IsThere) { EXPECT_NE(kernelOf(entry.op), nullptr); }

TEST_P(EveryKernel, GivesWhatItsFunctionGivesWhateverVaries) {
  if (!hasReference(entry.op)) GTEST_SKIP();
  ASSERT_TRUE(references().count(entry.op));
  const auto count = static_cast<uint32_t>(entry.takes.size());
  std::vector<uint32_t> masks;
  for (uint32_t m = 0; m < 1u << std::min(count, 4u); ++m) masks.push_back(m);
  masks.push_back((1u << count) - 1);
  for (int round = 0; round < 40 && !HasFatalFailure(); ++round)
    for (uint32_t mask : masks) {
      std::vector<Values> in = arguments(mask, round % 2);
      Values out(entry.floatsOut(), kBlocks, true);
      std::vector<Lanes> lanes;
      for (Values& v : in) lanes.push_back(v.lanes());
      kernelOf(entry.op)(kBlocks, out.lanes(), lanes.data());
      expectReference(in, out, "with uniform arguments " + std::to_string(mask));
      if (HasFatalFailure()) return;
    }
}

INSTANTIATE_TEST_SUITE_P(OfTheTable, EveryKernel, testing::ValuesIn(entries()),
                         [](const auto& of) { return of.param.name; });

}  // namespace
}  // namespace tomales::compiler

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "references.h"

namespace tomales::compiler {
namespace {

constexpr int kBlocks = 5, kPoints = kBlocks * kBlock;

/// A function of one point on the floats of all its arguments.
struct Reference {
  std::function<void(const float* in, float* out)> of;
  int ulps;
};

template <class T>
T taken(const float*& at) {
  T value;
  std::copy_n(at, sizeof value / sizeof(float), reinterpret_cast<float*>(&value));
  at += sizeof value / sizeof(float);
  return value;
}
template <class Op, class Out, class... In>
std::function<void(const float*, float*)> onFloats(const Op& op, Out (Op::*)(In...) const) {
  return [op](const float* in, float* out) {
    const std::tuple<std::decay_t<In>...> arguments{taken<std::decay_t<In>>(in)...};
    const Out result = std::apply(op, arguments);
    std::memcpy(out, &result, sizeof result);
  };
}
struct References {
  std::map<Op, Reference> all;
  template <class F>
  void bits(Op op, const F& f) {
    all[op] = {onFloats(f, &F::operator()), 0};
  }
  /// Rounded once, from double precision: both may lie on either side of the middle between two floats.
  template <class F>
  void library(Op op, const F& f) {
    all[op].ulps = 1;
    all[op].of = [f](const float* in, float* out) {
      if constexpr (std::is_invocable_v<F, double>)
        *out = static_cast<float>(f(static_cast<double>(in[0])));
      else
        *out = static_cast<float>(f(static_cast<double>(in[0]), static_cast<double>(in[1])));
    };
  }
};
const std::map<Op, Reference>& references() {
  static const References built = [] {
    References r;
    visitReferences(r);
    return r;
  }();
  return built.all;
}

class EveryKernel : public testing::TestWithParam<Entry> {
 protected:
  const Entry entry = GetParam();
  Numbers numbers{static_cast<uint32_t>(entry.op) + 1};

  /// Slopes are held against differences: slopes_test.cpp.
  bool hasReference() const { return entry.op != Op::Slope3F && entry.op != Op::Slope3T; }
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
  static std::vector<Lanes> lanesOf(std::vector<Values>& values) {
    std::vector<Lanes> lanes;
    for (Values& v : values) lanes.push_back(v.lanes());
    return lanes;
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
        const bool exact = reference.ulps == 0 && got == got;
        if (exact ? std::memcmp(&got, &wanted[c], sizeof got) == 0 : ulpsBetween(got, wanted[c]) <= reference.ulps)
          continue;
        FAIL() << what << ", component " << c << " of " << testing::PrintToString(flat) << ": " << got << ", not "
               << wanted[c];
      }
    }
  }
};

TEST_P(EveryKernel, IsThereAndSoIsWhatItIsHeldAgainst) {
  EXPECT_NE(kernelOf(entry.op), nullptr);
  EXPECT_EQ(references().count(entry.op), hasReference() ? 1u : 0u);
}

TEST_P(EveryKernel, GivesWhatItsFunctionGivesWhateverVaries) {
  if (!hasReference()) return;
  const uint32_t all = (1u << entry.takes.size()) - 1;
  for (int round = 0; round < 40 && !HasFatalFailure(); ++round)
    for (uint32_t uniform = 0; uniform < 16 && !HasFatalFailure(); ++uniform) {
      std::vector<Values> in = arguments(uniform == 15 ? all : uniform & all, round % 2);
      Values out(entry.floatsOut(), kBlocks, true);
      kernelOf(entry.op)(kBlocks, out.lanes(), lanesOf(in).data());
      expectReference(in, out, "uniform: " + std::to_string(uniform));
    }
}

/// Noise has a shorter way for blocks of points that are all near the origin: at its edges, and between cells.
TEST_P(EveryKernel, GivesItAtWholeNumbersAndAsFarOutAsBlocksAreNear) {
  if (!hasReference() || references().at(entry.op).ulps > 0) return;
  static const float kEdges[] = {0.0f, -0.0f, 1.0f, -1.0f, -2.0f, -0.5f, -1e-30f, 0x1.fffffep+18f, -0x1.fffffep+18f};
  for (const float scale : {1.0f, 2.0f}) {
    std::vector<Values> in = arguments(0, true);
    for (Values& v : in)
      for (size_t k = 0; k < v.data.size(); ++k) v.data[k] = scale * kEdges[(k * 7 + k / 16) % std::size(kEdges)];
    Values out(entry.floatsOut(), kBlocks, true);
    kernelOf(entry.op)(kBlocks, out.lanes(), lanesOf(in).data());
    expectReference(in, out, "edges");
  }
}

TEST_P(EveryKernel, ComputesOneBlockForAUniformResult) {
  if (!hasReference()) return;
  std::vector<Values> in = arguments(~0u, true);
  Values out(entry.floatsOut(), kBlocks, false);
  kernelOf(entry.op)(1, out.lanes(), lanesOf(in).data());
  expectReference(in, out, "all uniform");
}

/// As kernels.h allows it, for each argument in turn.
TEST_P(EveryKernel, WritesOverAnArgumentWhereItIsComponentwise) {
  if (entry.gives != "*") return;
  for (size_t k = 0; k < entry.takes.size(); ++k) {
    std::vector<Values> in = arguments(0, true), before = in;
    const std::vector<Lanes> lanes = lanesOf(in);
    kernelOf(entry.op)(kBlocks, lanes[k], lanes.data());
    expectReference(before, in[k], "over argument " + std::to_string(k));
  }
}

/// A number in the place of a triple: its component step is 0.
TEST_P(EveryKernel, TakesANumberForATripleAsThreeOfIt) {
  if (!hasReference() || entry.takes.find('t') == std::string::npos) return;
  std::vector<Values> in = arguments(0, true);
  std::vector<Lanes> lanes = lanesOf(in);
  for (size_t k = 0; k < in.size(); ++k) {
    if (entry.takes[k] != 't') continue;
    lanes[k].component = 0;
    for (int i = 0; i < kPoints; ++i) in[k].at(1, i) = in[k].at(2, i) = in[k].at(0, i);
  }
  Values out(entry.floatsOut(), kBlocks, true);
  kernelOf(entry.op)(kBlocks, out.lanes(), lanes.data());
  expectReference(in, out, "numbers for triples");
}

INSTANTIATE_TEST_SUITE_P(OfTheTable, EveryKernel, testing::ValuesIn(entries()),
                         [](const auto& of) { return of.param.name; });

}  // namespace
}  // namespace tomales::compiler

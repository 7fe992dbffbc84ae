// Every case gives its answer for batches of any size, whoever of the points is active, and leaves the others alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/rsl/cases.h"
#include "tests/unit/rsl/shaded.h"

namespace tomales::compiler {
namespace {

std::string textOf(const Case& c) {
  return fmt::format(
      "{}\n{} test({} output varying float x = 0; output varying color c = 0; output varying vector w = 0;) {{ {} }}\n",
      c.options.outside, c.options.kind, c.options.parameters, c.text);
}

bool isClose(float is, float should, float tolerance) {
  return std::isnan(should) ? std::isnan(is)
                            : is == should || std::abs(is - should) <= tolerance * std::max(1.0f, std::abs(should));
}

/// What is wrong with a point; empty: nothing. Each of the three outputs is followed by what is given to it.
std::string fault(const Case& c, const ServedGrid& g, int i) {
  const float x = g.output(g.params.size() - 6)[i];
  Vec3 at;
  float* const to[3] = {&at.x, &at.y, &at.z};
  const bool on = g.active[static_cast<size_t>(i)] != 0;
  for (int k = 0; k < 3; ++k) {
    const float color = g.output(g.params.size() - 4, k)[i], vector = g.output(g.params.size() - 2, k)[i];
    *to[k] = on ? color + vector : color;
  }
  if (!on) return x == FakeGrid::kBefore.x && at.x == FakeGrid::kBefore.x ? "" : "an inactive point has changed";
  const auto index = static_cast<float>(i);
  if (c.number) {
    const float should = c.number(index);
    return isClose(x, should, c.options.tolerance) ? "" : fmt::format("{} where {} is right", x, should);
  }
  const Vec3 should = c.triple(index);
  const float t = c.options.tolerance;
  if (isClose(at.x, should.x, t) && isClose(at.y, should.y, t) && isClose(at.z, should.z, t)) return "";
  return fmt::format("({} {} {}) where ({} {} {}) is right", at.x, at.y, at.z, should.x, should.y, should.z);
}

bool expectOver(const Case& c, const CompiledText& compiled, int count, bool masked) {
  ServedGrid g(count);
  if (masked) g.maskAtRandom();
  g.run(compiled.shader());
  for (int i = 0; i < count; ++i)
    if (const std::string what = fault(c, g, i); !what.empty()) {
      ADD_FAILURE() << c.rule << "\n  " << c.text << "\n  point " << i << " of " << count
                    << (masked ? ", some of them inactive" : "") << ": " << what;
      return false;
    }
  const bool any = std::any_of(g.active.begin(), g.active.end(), [](uint8_t a) { return a != 0; });
  const std::string told = g.reports.empty() ? "" : g.reports.front();
  if (!any) return true;
  const bool right = c.options.message ? told.find(c.options.message) != std::string::npos : told.empty();
  EXPECT_TRUE(right) << c.rule << ": it says \"" << told << '"';
  return right;
}

class Conformance : public ::testing::TestWithParam<std::pair<const char*, Cases>> {};

TEST_P(Conformance, IsThatOfTheSpecification) {
  for (const Case& c : GetParam().second) {
    const CompiledText compiled(textOf(c));
    if (!compiled.good()) {
      ADD_FAILURE() << c.rule << "\n" << compiled.said();
      continue;
    }
    bool right = true;
    for (const int count : {1, 17, 256, 1000})
      for (const bool masked : {false, true}) right = right && expectOver(c, compiled, count, masked);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Conformance, ::testing::ValuesIn(allCases()),
                         [](const auto& of) { return of.param.first; });

TEST(ConformanceTables, HaveThreeHundredCasesAndMore) {
  size_t all = 0;
  for (const auto& [name, cases] : allCases()) all += cases.size();
  EXPECT_GE(all, 300u);
}

bool isCalled(std::string_view name, std::string_view text) {
  for (size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
    const auto isWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    if (at > 0 && isWord(text[at - 1])) continue;
    const size_t next = text.find_first_not_of(' ', at + name.size());
    if (next != text.npos && text[next] == '(') return true;
  }
  return false;
}

TEST(ConformanceTables, MentionEveryBuiltInFunction) {
  std::vector<std::string> names;
  for (const Builtin& b : builtins()) names.push_back(b.name);
  for (const auto& f : prelude().file.functions) names.push_back(f->name);
  for (const std::string& name : names) {
    if (name.starts_with("__")) continue;
    bool called = false;
    for (const auto& [table, cases] : allCases())
      for (const Case& c : cases) called |= isCalled(name, c.text);
    EXPECT_TRUE(called) << name << "() is in no case";
  }
}

}  // namespace
}  // namespace tomales::compiler

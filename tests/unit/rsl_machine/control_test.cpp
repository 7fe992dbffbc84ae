// Masks: conditions, loops, scopes and what leaves them, against one point at a time.
#include <gtest/gtest.h>

#include <random>

#include "reyes/base/stop.h"
#include "reyes/rsl/machine/machine.h"
#include "tests/unit/rsl_machine/fake_grid.h"
#include "tests/unit/rsl_machine/programs.h"

namespace tomales::compiler {
namespace {

Choice numbersFrom(std::mt19937& random) {
  return [&random](uint32_t below) { return static_cast<uint32_t>(random() % below); };
}

TEST(Control, RandomProgramsDoToEachPointWhatPlainControlFlowDoes) {
  for (uint32_t seed = 0; seed < 3000; ++seed) {
    std::mt19937 random(seed);
    const Choice choice = numbersFrom(random);
    MadeProgram made(choice);
    const int count = std::array{1, 7, 16, 33, 64}[seed % 5];
    FakeGrid fake(count);
    for (int i = 0; i < count; ++i) fake.active[static_cast<size_t>(i)] = count == 1 || choice(5) != 0;
    fake.bind(made.b.code);
    const Program program(std::move(made.b.code));
    run(program, fake.grid);
    for (int i = 0; i < count; ++i) {
      if (!fake.active[static_cast<size_t>(i)]) {
        for (size_t k = 0; k < MadeProgram::kOutputs; ++k) ASSERT_EQ(fake.output(k)[i], 0) << "not active";
        continue;
      }
      const OnePoint alone(program.code(), fake.grid.u[i]);
      for (int k = 0; k < MadeProgram::kOutputs; ++k)
        ASSERT_EQ(fake.output(static_cast<size_t>(k))[i], alone.parameter(k))
            << "seed " << seed << ", point " << i << ", output " << k;
    }
  }
}

/// An output "count" and the number of the point.
struct Counting {
  Builder b;
  int32_t count = b.parameter("count", Base::Float, {0}, true), s = b.global("s", Shape::Number);
  FakeGrid fake;
  explicit Counting(int points) : fake(points) {}
  void add(int32_t to, float x) { b.copy(to, b.value(Op::Add, {to, b.number(x)})); }
  void run() {
    fake.bind(b.code);
    const Program program(std::move(b.code));
    compiler::run(program, fake.grid);
  }
  float operator[](int i) const { return fake.output(0)[i]; }
};

TEST(Control, ALoopGoesRoundForEachPointAsOftenAsItsConditionHolds) {
  Counting c(40);
  const int32_t holds = c.b.temporary();
  c.b.loop(
      holds, c.b.label(2),
      [&] {
        c.b.emit(Op::Less, {holds}, {c.count, c.s});
      },
      [&] { c.add(c.count, 1); });
  c.run();
  for (int i = 0; i < 40; ++i) EXPECT_EQ(c[i], static_cast<float>(i));
}

TEST(Control, BreakLeavesTheLoopAndContinueGoesToItsStep) {
  Counting c(20);
  const int32_t holds = c.b.temporary(), k = c.b.variable(), label = c.b.label(2);
  c.b.loop(
      holds, label,
      [&] {
        c.b.emit(Op::Less, {holds}, {k, c.b.number(10)});
      },
      [&] {
        c.b.branch(c.b.value(Op::Equal, {k, c.s}), [&] { c.b.leave(label); });
        c.b.branch(c.b.value(Op::Less, {k, c.b.number(3)}), [&] { c.b.leave(label + 1); });
        c.add(c.count, 1);
      },
      [&] { c.add(k, 1); });
  c.run();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(c[i], static_cast<float>(std::max(0, std::min(i, 10) - 3))) << i;
}

TEST(Control, ALoopWithoutEndIsReportedAndTheBatchGetsWhatThereIs) {
  setLoopLimit(1000);
  Counting c(5);
  const int32_t holds = c.b.number(1);
  c.b.branch(
      c.b.value(Op::Less, {c.s, c.b.number(2)}),
      [&] {
        c.b.copy(c.count, c.b.number(3));
        c.b.loop(
            holds, c.b.label(2), [] {}, [&] { c.add(c.count, 1); });
        c.b.copy(c.count, c.b.number(-1));
      },
      [&] { c.b.copy(c.count, c.b.number(-2)); });
  c.b.copy(c.count, c.b.number(-3));
  c.run();
  setLoopLimit(5'000'000);
  ASSERT_EQ(c.fake.reports.size(), 1u);
  EXPECT_NE(c.fake.reports[0].find("1000 iterations"), std::string::npos) << c.fake.reports[0];
  for (int i = 0; i < 5; ++i) EXPECT_EQ(c[i], i < 2 ? 1003.0f : 0.0f) << "nothing more runs";
}

TEST(Control, AWishToStopEndsALoop) {
  setLoopLimit(0);
  Counting c(5);
  c.b.loop(
      c.b.number(1), c.b.label(2), [] {}, [&] { c.add(c.count, 1); });
  requestStop();
  c.run();
  requestStop(false);
  setLoopLimit(5'000'000);
  EXPECT_EQ(c[0], 0);
}

TEST(Control, UnmaskedInstructionsReachAllPoints) {
  Counting c(20);
  c.b.branch(c.s, [&] { c.b.emit(Op::Copy, {c.count}, {c.b.number(4)}).masked = false; });
  c.run();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(c[i], 4);
}

/// The host calls a shader while another waits for its answer, on the same thread.
TEST(Control, ProgramsRunWithinServicesOfOthers) {
  // Each run keeps a number and a text of its own over two services, in which others run.
  Builder b;
  const int32_t out = b.parameter("out", Base::Float, {0}, true), time = b.global("time", Shape::Number, false),
                u = b.global("u", Shape::Number), kept = b.variable(), label = b.variable(Shape::Text);
  const int32_t pattern = b.text("a text that is longer than a short one, at %f");
  b.copy(kept, time);
  b.emit(Op::Format, {label}, {pattern, time});
  b.branch(b.value(Op::Less, {u, b.number(0.7f)}), [&] {
    for (int k = 0; k < 2; ++k) b.emit(Op::Ambient, {b.temporary(Shape::Triple)}, {});
    const int32_t again = b.value(Op::Format, {pattern, time}, Shape::Text);
    b.branch(b.value(Op::TextEqual, {label, again}), [&] { b.copy(out, kept); });
  });
  static const Program* running;
  static int depth, runs;
  const auto ambient = [](void*, const TmGrid* g, TmVec3) {
    if (depth == 3) return;
    ++depth;
    ++runs;
    FakeGrid inner(300);
    inner.services.ambient = g->call->ambient;
    inner.bind(running->code());
    inner.grid.time = static_cast<float>(10 * runs);
    const float expected = inner.grid.time;
    run(*running, inner.grid);
    EXPECT_EQ(inner.output(0)[0], expected);
    --depth;
  };
  FakeGrid fake(64);
  fake.bind(b.code);
  fake.services.ambient = ambient;
  const Program program(std::move(b.code));
  running = &program;
  depth = runs = 0;
  run(program, fake.grid);
  EXPECT_EQ(runs, 2 + 4 + 8);
  for (int i = 0; i < 64; ++i) EXPECT_EQ(fake.output(0)[i], fake.grid.u[i] < 0.7f ? 0.25f : 0.0f);
}

}  // namespace
}  // namespace tomales::compiler

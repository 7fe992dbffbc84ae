// What instructions ask of the renderer, and what comes back into registers.
#include <gtest/gtest.h>

#include "reyes/rsl/machine/machine.h"
#include "tests/unit/rsl_machine/builder.h"
#include "tests/unit/rsl_machine/fake_grid.h"

namespace tomales::compiler {
namespace {

void runOn(FakeGrid& fake, Builder& b) {
  fake.bind(b.code);
  const Program program(std::move(b.code));
  run(program, fake.grid);
}

TEST(Services, OfASurfaceObeyTheMask) {
  FakeGrid fake(20);
  fake.active[3] = 0;
  Builder b;
  const int32_t Ci = b.global("Ci", Shape::Triple), u = b.global("u", Shape::Number);
  b.branch(b.value(Op::Less, {u, b.number(0.5f)}), [&] { b.copy(Ci, b.value(Op::Ambient, {}, Shape::Triple)); });
  runOn(fake, b);
  ASSERT_EQ(fake.masks.size(), 1u);
  for (int i = 0; i < 20; ++i) {
    const bool on = i < 10 && i != 3;
    EXPECT_EQ(fake.masks[0][static_cast<size_t>(i)], on);
    const rsl::Vec3 c = rsl::get(fake.grid.Ci, i);
    EXPECT_EQ(c.z, i == 3 ? -7 : on ? static_cast<float>(i) : 1.0f) << i;  // Ci starts as Cs
    EXPECT_EQ(fake.grid.Oi.y[i], i == 3 ? -7 : 0.5f) << "what is not assigned of Oi is Os";
  }
}

}  // namespace
}  // namespace tomales::compiler

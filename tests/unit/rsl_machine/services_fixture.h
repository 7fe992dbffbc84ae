// A code with outputs, to look at what registers hold.
#pragma once
#include <gtest/gtest.h>

#include "reyes/rsl/machine/machine.h"
#include "tests/unit/rsl_machine/builder.h"
#include "tests/unit/rsl_machine/fake_grid.h"

namespace tomales::compiler {

class Services : public ::testing::Test {
 protected:
  int32_t number() { return b.parameter("out" + std::to_string(b.code.parameters.size()), Base::Float, {-5}, true); }
  int32_t triple() {
    return b.parameter("out" + std::to_string(b.code.parameters.size()), Base::Color, {-5, -5, -5}, true);
  }
  void run() {
    fake.bind(b.code);
    const Program program(std::move(b.code));
    compiler::run(program, fake.grid);
  }
  rsl::Vec3 at(size_t output, int i) const {
    return {fake.output(output)[i], fake.output(output, 1)[i], fake.output(output, 2)[i]};
  }
  void expect(const rsl::Vec3& is, const rsl::Vec3& should) {
    EXPECT_EQ(is.x, should.x);
    EXPECT_EQ(is.y, should.y);
    EXPECT_EQ(is.z, should.z);
  }
  int32_t where(float u) { return b.value(Op::Less, {b.global("u", Shape::Number), b.number(u)}); }
  Setting setting(const std::string& name, int32_t value, bool fills = false, Base base = Base::Float) {
    return {b.text(name), value, fills, base};
  }
  bool reported(const std::string& what) const {
    return std::any_of(fake.reports.begin(), fake.reports.end(),
                       [&](const std::string& r) { return r.find(what) != std::string::npos; });
  }
  FakeGrid fake{20};
  Builder b;
};

}  // namespace tomales::compiler

#include <fmt/format.h>

#include "reyes/rsl/checker.h"

namespace tomales::compiler {

void Checker::illuminance(Stmt& s) {
  auto& e = s.exprs;
  for (const ExprPtr& part : e) type(*part);
  size_t at = !e.empty() && e[0]->type.is(Base::String) ? 1 : 0;
  if (at >= e.size()) return messages_.error(s.place, "illuminance() needs a position");
  expect(*e[at++], {Base::Point}, "as the position of illuminance()");
  if (at < e.size() && !e[at]->type.is(Base::String)) {
    if (at + 1 >= e.size() || e[at + 1]->type.is(Base::String))
      return messages_.error(s.place, "illuminance() needs an axis and an angle after the position, or neither");
    expect(*e[at++], {Base::Vector}, "as the axis of illuminance()");
    expect(*e[at++], {Base::Float}, "as the angle of illuminance()");
  }
  list(e, at, "illuminance");
  loopBody(*s.body[0]);
}

void Checker::illuminate(Stmt& s) {
  auto& e = s.exprs;
  if (e.size() != 1 && e.size() != 3)
    return messages_.error(s.place, "illuminate() takes a position, or a position, an axis and an angle");
  expect(*e[0], {Base::Point}, "as the position of illuminate()");
  if (e.size() == 3) {
    expect(*e[1], {Base::Vector}, "as the axis of illuminate()");
    expect(*e[2], {Base::Float}, "as the angle of illuminate()");
  }
  statement(*s.body[0]);
}

void Checker::solar(Stmt& s) {
  auto& e = s.exprs;
  if (!e.empty() && e.size() != 2) return messages_.error(s.place, "solar() takes nothing, or an axis and an angle");
  if (!e.empty()) {
    expect(*e[0], {Base::Vector}, "as the axis of solar()");
    expect(*e[1], {Base::Float}, "as the angle of solar()");
  }
  statement(*s.body[0]);
}

void Checker::gather(Stmt& s) {
  auto& e = s.exprs;
  for (const ExprPtr& part : e) type(*part);
  if (e.size() < 5)
    return messages_.error(s.place, "gather() takes a category, position, direction, angle, and number of samples");
  const Base wanted[5] = {Base::String, Base::Point, Base::Vector, Base::Float, Base::Float};
  for (size_t i = 0; i < 5; ++i) expect(*e[i], {wanted[i]}, fmt::format("as argument {} of gather()", i + 1).c_str());
  list(e, 5, "gather");
  loopBody(*s.body[0]);
  if (s.body.size() > 1) statement(*s.body[1]);
}

}  // namespace tomales::compiler

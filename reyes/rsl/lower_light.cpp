// Light: illuminance and gather, which are loops, and the statements by which light shaders state where they shine.
#include <algorithm>
#include <iterator>

#include "reyes/rsl/lowering.h"

namespace tomales::compiler {

template <class Body>
void Lowering::breakable(const Stmt& within, const Body& body) {
  if (!contains(within, {StmtKind::Break, StmtKind::Continue})) {
    loops_.push_back({-1, -1});
    body([&](const Stmt& s) { return block([&] { statement(s); }); });
    loops_.pop_back();
    return;
  }
  const int32_t leave = code_.labels++, next = code_.labels++;
  loops_.push_back({leave, next});
  const auto scope = [&](int32_t label, Block inner) {
    Instruction& i = emit(Op::Scope, {}, {});
    i.extra = label;
    i.blocks.push_back(std::move(inner));
  };
  Block all =
      block([&] { body([&](const Stmt& s) { return block([&] { scope(next, block([&] { statement(s); })); }); }); });
  scope(leave, std::move(all));
  loops_.pop_back();
}

void Lowering::illuminance(const Stmt& s) {
  const auto& e = s.exprs;
  size_t at = e[0]->type.is(Base::String) ? 1 : 0;
  const int32_t category = at == 1 ? value(*e[0]) : -1, position = value(*e[at++]);
  int32_t axis = -1, angle = -1;
  if (at < e.size() && !e[at]->type.is(Base::String)) {
    axis = value(*e[at++]);
    angle = value(*e[at++]);
  }
  std::vector<std::pair<const Expr*, int32_t>> after;
  const std::vector<Setting> list = settings(e, at, "illuminance", after);
  const int32_t L = global(Global::L), Cl = global(Global::Cl);
  breakable(*s.body[0], [&](const auto& bodyOf) {
    Block body = bodyOf(*s.body[0]);
    Block stores = block([&] {
      for (const auto& [to, from] : after) store(*to, from);
    });
    body.insert(body.begin(), std::make_move_iterator(stores.begin()), std::make_move_iterator(stores.end()));
    Instruction& i = emit(Op::Illuminance, {L, Cl}, {category, position, axis, angle});
    i.settings = list;
    i.blocks.push_back(std::move(body));
  });
}

void Lowering::gather(const Stmt& s) {
  const auto& e = s.exprs;
  std::vector<int32_t> in;
  for (size_t i = 0; i < 5; ++i) in.push_back(value(*e[i]));
  std::vector<std::pair<const Expr*, int32_t>> after;
  const std::vector<Setting> list = settings(e, 5, "gather", after);
  for (const auto& [to, from] : after)
    messages_.error(to->place, "gather() fills plain variables only, not elements of arrays", to->length);
  breakable(s, [&](const auto& bodyOf) {
    Block hit = bodyOf(*s.body[0]), miss;
    if (s.body.size() > 1) miss = bodyOf(*s.body[1]);
    Instruction& i = emit(Op::Gather, {}, in);
    i.settings = list;
    i.blocks.push_back(std::move(hit));
    i.blocks.push_back(std::move(miss));
  });
}

int Lowering::lightsOf(const Expr& e) {
  int sum = e.function ? lightsOf(*e.function->body) : 0;
  for (const ExprPtr& part : e.args) sum += lightsOf(*part);
  return sum;
}

int Lowering::lightsOf(const Stmt& s) {
  if (s.kind == StmtKind::Illuminate || s.kind == StmtKind::Solar) return 1;
  if (s.kind == StmtKind::Define) return 0;
  int sum = 0, most = 0;
  for (const ExprPtr& e : s.exprs) sum += e ? lightsOf(*e) : 0;
  for (const StmtPtr& inner : s.body) {
    const int lights = lightsOf(*inner);
    sum += lights;
    most = std::max(most, lights);
  }
  if (s.kind == StmtKind::If) return most;
  return s.kind == StmtKind::While || s.kind == StmtKind::For ? 2 * sum : sum;
}

namespace {

/// Tells whether the expression is N or Ng, perhaps normalized.
bool isNormal(const Expr& e) {
  if (e.kind == ExprKind::Call && e.text == "normalize" && e.args.size() == 1) return isNormal(*e.args[0]);
  const int32_t global = e.kind == ExprKind::Name && e.variable ? e.variable->global : -1;
  return global == static_cast<int32_t>(Global::N) || global == static_cast<int32_t>(Global::Ng);
}

}  // namespace

void Lowering::noteCone(const Expr& axis, int32_t angle) {
  if (!code_.onGeometry) return;
  const Register& r = code_.registers[static_cast<size_t>(angle)];
  const bool turned = axis.kind == ExprKind::Unary && axis.text == "-" && isNormal(*axis.args[0]);
  if (turned || (r.origin == Origin::Constant && r.floats[0] > kRightAngle)) {
    code_.allRound = true;
  } else if (r.origin != Origin::Constant) {
    if (code_.cone < 0) code_.cone = add({.origin = Origin::Variable});
    copy(code_.cone, compute(Op::Max, {code_.cone, angle}));
  }
}

void Lowering::illuminate(const Stmt& s) {
  const int32_t from = value(*s.exprs[0]), L = global(Global::L);
  const int32_t ray = compute(Op::Sub, {global(Global::Ps), from}, Shape::Triple);
  const bool cone = s.exprs.size() > 1;
  int32_t direction = ray;
  // Where one of several cones does not shine, another one's direction stays. If there is none yet, L still needs a
  // direction, because surfaces divide by its length.
  if (cone && shinesFromMany_)
    direction = compute(Op::Select, {compute(Op::TripleEqual, {L, number(0)}), ray, L}, Shape::Triple);
  copy(L, direction);
  if (!cone) {
    code_.allRound = true;
    return statement(*s.body[0]);
  }
  const int32_t axis = compute(Op::Normalize, {value(*s.exprs[1])}), angle = value(*s.exprs[2]);
  noteCone(*s.exprs[1], angle);
  const int32_t cosine = compute(Op::Dot, {compute(Op::Normalize, {ray}), axis});
  const int32_t inside = compute(Op::LessEqual, {compute(Op::Cos, {angle}, Shape::Number), cosine});
  ifElse(inside, block([&] {
           if (shinesFromMany_) copy(L, ray);
           statement(*s.body[0]);
         }),
         {});
}

void Lowering::solar(const Stmt& s) {
  const int32_t L = global(Global::L);
  if (s.exprs.empty()) {
    copy(L, compute(Op::SkyLight, {}));
  } else {
    const int32_t axis = value(*s.exprs[0]), angle = value(*s.exprs[1]);
    copy(L, compute(Op::ConeLight, {axis, angle}));
  }
  statement(*s.body[0]);
}

}  // namespace tomales::compiler

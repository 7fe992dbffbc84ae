#include <fmt/format.h>

#include "reyes/base/math.h"
#include "reyes/rsl/checker.h"

namespace tomales::compiler {
namespace {

bool isTriplet(const Expr& e) { return e.kind == ExprKind::Tuple && e.args.size() == 3; }

}  // namespace

int Checker::distance(const Expr& e, const Type& to) const {
  if (isTriplet(e) && to.isTriple()) return 0;
  const std::optional<int> far = conversion(e.type, to);
  return far ? *far : -1;
}

Type Checker::type(Expr& e) {
  e.checked = true;
  switch (e.kind) {
    case ExprKind::Number:
      return e.type = {Base::Float};
    case ExprKind::String:
      return e.type = {Base::String};
    case ExprKind::Name:
      return e.type = typeOfName(e);
    case ExprKind::Index:
      return e.type = typeOfIndex(e);
    case ExprKind::Tuple:
      return e.type = typeOfTuple(e);
    case ExprKind::Unary:
      return e.type = typeOfUnary(e);
    case ExprKind::Binary:
      return e.type = typeOfBinary(e);
    case ExprKind::Conditional:
      return e.type = typeOfConditional(e);
    case ExprKind::Assign:
      return e.type = typeOfAssign(e);
    case ExprKind::Call:
      return e.type = typeOfCall(e);
    case ExprKind::Cast:
      return e.type = typeOfCast(e);
    case ExprKind::Comma:
      for (const ExprPtr& part : e.args) e.type = type(*part);
      return e.type;
  }
  return kUnknown;
}

Type Checker::typeOfName(Expr& e) {
  Variable* v = find(e.text);
  if (!v && e.text == "PI") {
    e.kind = ExprKind::Number;
    e.number = kPi;
    return {Base::Float};
  }
  if (!v) {
    if (told_.insert({0, e.text}).second) {
      const auto near = nearNames(e.text, visibleNames());
      messages_.error(e.place,
                      fmt::format("there is no variable \"{}\"{}", e.text,
                                  near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near.front())),
                      e.length);
    }
    return kUnknown;
  }
  while (v->outer) {
    v->used = true;
    v = v->outer;
  }
  v->used = true;
  e.variable = v;
  return v->type;
}

Type Checker::typeOfIndex(Expr& e) {
  const Type of = type(*e.args[0]);
  expect(*e.args[1], {Base::Float}, "as an index");
  if (of.is(Base::String)) return of;  // a channel of a picture, which only the functions of pictures take
  if (of == kUnknown) return of;
  if (of.isTriple()) return {Base::Float};  // RISpec has no such components, but later shaders write them
  if (!of.isArray()) {
    messages_.error(e.place, fmt::format("\"{}\" is a {}, not an array", e.args[0]->text, name(of)), e.length);
    return kUnknown;
  }
  return {of.base};
}

Type Checker::typeOfTuple(Expr& e) {
  bool texts = !e.args.empty();
  for (const ExprPtr& part : e.args) texts &= type(*part).is(Base::String);
  if (texts) return {Base::String, static_cast<int32_t>(e.args.size())};
  const Type element =
      e.args.size() == 3 || e.args.size() == 16 || e.args.empty() ? Type{Base::Float} : e.args[0]->type;
  for (const ExprPtr& part : e.args) expect(*part, element, "in a tuple");
  if (e.args.size() == 3) return {Base::Vector};
  if (e.args.size() == 16) return {Base::Matrix};
  return {element.base, static_cast<int32_t>(e.args.size())};
}

Type Checker::typeOfUnary(Expr& e) {
  const Type of = type(*e.args[0]);
  if (e.text == "!") {
    expect(*e.args[0], {Base::Float}, "after '!'");
    return {Base::Float};
  }
  if (of == kUnknown || isNumeric(of) || of.is(Base::Matrix)) return of;
  messages_.error(e.place, fmt::format("there is no '{}' of a {}", e.text, name(of)), e.length);
  return kUnknown;
}

Type Checker::typeOfBinary(Expr& e) {
  Expr &a = *e.args[0], &b = *e.args[1];
  type(a);
  type(b);
  // A bare (x, y, z) takes the type of the other side.
  if (isTriplet(a) && !isTriplet(b) && b.type.isTriple()) a.type = b.type;
  if (isTriplet(b) && !isTriplet(a) && a.type.isTriple()) b.type = a.type;
  const std::optional<Operation> operation = binaryOperation(e.text, a.type, b.type);
  if (!operation) {
    messages_.error(e.place, fmt::format("there is no {} {} {}", name(a.type), e.text, name(b.type)), e.length);
    return kUnknown;
  }
  if (e.text == "==" && a.type.is(Base::Float) && a.kind != ExprKind::Number && b.kind != ExprKind::Number &&
      a.kind == ExprKind::Binary)
    messages_.warning(e.place, "'==' of a computed number: rounding may make the two differ", e.length);
  return operation->result;
}

Type Checker::typeOfConditional(Expr& e) {
  condition(*e.args[0]);
  Expr &a = *e.args[1], &b = *e.args[2];
  type(a);
  type(b);
  if (distance(b, a.type) >= 0 && !(a.type.is(Base::Float) && b.type.isTriple())) {
    retarget(b, a.type);
    return a.type;
  }
  if (distance(a, b.type) >= 0) {
    retarget(a, b.type);
    return b.type;
  }
  messages_.error(e.place, fmt::format("the two values of '?:' are a {} and a {}", name(a.type), name(b.type)),
                  e.length);
  return kUnknown;
}

void Checker::assigned(Expr& e, const char* where) {
  Expr* to = &e;
  while (to->kind == ExprKind::Index) to = to->args[0].get();
  if (to->kind != ExprKind::Name || !to->variable) {
    if (e.type != kUnknown)
      messages_.error(e.place, fmt::format("a variable is needed {}, to be assigned", where), e.length);
    return;
  }
  to->variable->assigned = true;
}

Type Checker::typeOfAssign(Expr& e) {
  Expr &to = *e.args[0], &value = *e.args[1];
  const bool usedBefore = to.kind == ExprKind::Name && find(to.text) && find(to.text)->used;
  const Type target = type(to);
  if (e.text == "=" && to.kind == ExprKind::Name && to.variable) to.variable->used = usedBefore;
  assigned(to, "on the left of an assignment");
  if (e.text == "=") {
    expect(value, target, "on the right of '='");
    return target;
  }
  type(value);
  const std::string op = e.text.substr(0, e.text.size() - 1);
  op == "*" || op == "/" ? retargetFactor(value, target) : retarget(value, target);
  const std::optional<Operation> operation = binaryOperation(op, target, value.type);
  if (!operation || !conversion(operation->result, target))
    messages_.error(e.place, fmt::format("there is no {} {} {}", name(target), e.text, name(value.type)), e.length);
  return target;
}

Type Checker::typeOfCast(Expr& e) {
  Expr& value = *e.args[0];
  type(value);
  expect(value, e.written, "in a cast");
  if (e.hasSpace && (e.written.is(Base::Float) || e.written.is(Base::String)))
    messages_.error(e.place, fmt::format("a {} has no space", name(e.written)), e.length);
  return e.written;
}

// RISpec 15 chooses among functions of one name by the type of the result that is needed. That type is passed down
// through arithmetic: in `point Q = P + .1 * noise(P)` noise returns a point.
void Checker::retarget(Expr& e, const Type& wanted) {
  if (e.type == kUnknown || wanted == kUnknown) return;
  switch (e.kind) {
    case ExprKind::Tuple:
      if (isTriplet(e) && wanted.isTriple()) e.type = wanted;
      if (wanted.isArray()) {
        for (const ExprPtr& part : e.args) retarget(*part, {wanted.base});
        e.type = {wanted.base, static_cast<int32_t>(e.args.size())};
      }
      return;
    case ExprKind::Unary:
      if (e.text == "!") return;
      retarget(*e.args[0], wanted);
      e.type = e.args[0]->type;
      return;
    case ExprKind::Binary: {
      if (e.text != "+" && e.text != "-" && e.text != "*" && e.text != "/") return;
      const bool product = e.text == "*" || e.text == "/",
                 scaled = e.args[0]->type.isTriple() != e.args[1]->type.isTriple();
      for (const ExprPtr& part : e.args) {
        if (!wanted.isTriple() || !isNumeric(part->type) || (e.text == "/" && part == e.args[1])) continue;
        product&& scaled ? retargetFactor(*part, wanted) : retarget(*part, wanted);
      }
      const auto operation = binaryOperation(e.text, e.args[0]->type, e.args[1]->type);
      if (operation) e.type = operation->result;
      return;
    }
    case ExprKind::Conditional:
      retarget(*e.args[1], wanted);
      retarget(*e.args[2], wanted);
      e.type = e.args[e.args[1]->type.is(Base::Float) ? 2 : 1]->type;
      return;
    case ExprKind::Comma:
      retarget(*e.args.back(), wanted);
      e.type = e.args.back()->type;
      return;
    case ExprKind::Call: {
      if (e.missing) e.type = wanted;
      if (e.function && e.type != wanted)
        for (const Function* f : functionsOf(e.text))
          if (f->result == wanted && fit(e, *f) == fit(e, *e.function)) return void(e.type = typeOfFunction(e, *f));
      if (!e.builtin || e.type == wanted) return;
      int best = -1;
      const Builtin* chosen = nullptr;
      for (const Builtin* b : builtinsOf(e.text)) {
        const int far = fit(e, *b);
        if (far < 0 || Type{b->result} != wanted) continue;
        if (best < 0 || far < best) {
          best = far;
          chosen = b;
        }
      }
      if (chosen) e.type = typeOfBuiltin(e, *chosen);
      return;
    }
    default:
      return;
  }
}

Checker::Source Checker::sourceOf(const Expr& e) {
  if (!e.type.is(Base::Float) || e.text == "!") return Source::Numbers;
  bool keeps = e.kind == ExprKind::Unary || e.kind == ExprKind::Binary || e.kind == ExprKind::Conditional;
  if (e.kind == ExprKind::Call && e.builtin) {
    const Emit emit = e.builtin->emit;
    if (emit == Emit::Texture || emit == Emit::Environment || emit == Emit::Shadow || emit == Emit::List)
      return Source::Picture;
    keeps = info(e.builtin->op).signature[0] == '*';  // mix, clamp, min, max
    const auto all = builtinsOf(e.text);
    if (!keeps && std::any_of(all.begin(), all.end(), [](const Builtin* b) { return Type{b->result}.isTriple(); }))
      return Source::Noise;
  }
  Source out = Source::Numbers;
  for (size_t k = e.kind == ExprKind::Conditional ? 1 : 0; keeps && k < e.args.size(); ++k)
    out = std::max(out, sourceOf(*e.args[k]));
  return out;
}

// N * noise(P) moves points along N: as a factor of a triple, noise means a number. The colour of a picture stays a
// colour.
void Checker::retargetFactor(Expr& e, const Type& wanted) {
  if (e.kind == ExprKind::Tuple || e.type.isTriple() || (wanted.is(Base::Color) && sourceOf(e) == Source::Picture))
    retarget(e, wanted);
}

void Checker::expect(Expr& e, const Type& wanted, const char* where) {
  if (!e.checked) type(e);
  retarget(e, wanted);
  const int far = distance(e, wanted);
  if (far < 0 && e.type == Type{})
    messages_.error(e.place, fmt::format("a {} is needed {}, and {}() gives nothing", name(wanted), where, e.text),
                    e.length);
  else if (far < 0)
    messages_.error(e.place, fmt::format("a {} is needed {}, and this is a {}", name(wanted), where, name(e.type)),
                    e.length);
  else if (far > kDoubtful)
    messages_.warning(e.place, fmt::format("a {} is taken for a {} {}", name(e.type), name(wanted), where), e.length);
}

}  // namespace tomales::compiler

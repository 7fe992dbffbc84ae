#include <algorithm>
#include <iterator>
#include <utility>

#include "reyes/computed_default.h"
#include "reyes/rsl/lowering.h"
#include "reyes/rsl/passes/passes.h"
#include "reyes/rsl/passes/walk.h"

namespace tomales::compiler {
namespace {

/// Returns the default without a cast to shader space, which defaults are in anyway.
const Expr& inShaderSpace(const Expr& e) {
  const bool spatial = e.written.isTriple() && e.written.base != Base::Color;
  return e.kind == ExprKind::Cast && e.text == "shader" && spatial ? *e.args[0] : e;
}

/// Tells whether a part of the default is given in a space by name. A constant part in such a space ("current") is in
/// current space, but the host takes constant defaults to be in the shader's space.
bool namesSpace(const Expr& e) {
  const bool spatial = (e.written.isTriple() && e.written.base != Base::Color) || e.written.is(Base::Matrix);
  if (e.kind == ExprKind::Cast && !e.text.empty() && spatial) return true;
  return std::any_of(e.args.begin(), e.args.end(), [](const ExprPtr& a) { return namesSpace(*a); });
}

/// Tells whether the register is copied to at all points before anything else reads or writes it.
bool beginsWithCopy(const Block& block, int32_t reg) {
  for (const Instruction& i : block) {
    bool reads = false, writes = false;
    const auto look = [&](const Instruction& inner) {
      forEachRead(inner, [&](int32_t r) { reads |= r == reg; });
      forEachWrite(inner, [&](int32_t r) { writes |= r == reg; });
    };
    look(i);
    for (const Block& inner : i.blocks) forEach(inner, look);
    if (reads || writes) return !reads && i.op == Op::Copy;
  }
  return false;
}

}  // namespace

void Lowering::shader(const Shader& s) {
  code_.kind = s.kind;
  code_.name = s.name;
  code_.doc = s.doc;
  shinesFromMany_ = s.kind == ShaderKind::Light && lightsOf(*s.body) > 1;
  for (const auto& p : s.parameters) parameter(*p);
  code_.defaults = code_.body.size();
  functions_.push_back({-1, code_.labels++});
  if (contains(*s.body, {StmtKind::Return})) {
    Block body = block([&] { statement(*s.body); });
    Instruction& scope = emit(Op::Scope, {}, {});
    scope.extra = functions_.back().label;
    scope.blocks.push_back(std::move(body));
  } else {
    statement(*s.body);
  }
  if (s.kind == ShaderKind::Surface) beginColor();
  if (shinesFromMany_)
    messages_.warning(s.place,
                      "a point has light from one direction: where several illuminate() or solar() reach it, the last "
                      "gives the direction");
}

// RISpec leaves open what Ci and Oi hold at first. Here Oi is Os. Ci is Cs in shaders that never assign it and black in
// all others, as in PRMan, because many shaders begin with Ci +=.
void Lowering::beginColor() {
  const int32_t Ci = global(Global::Ci);
  bool assigned = false;
  forEach(code_.body, [&](const Instruction& i) { forEachWrite(i, [&](int32_t r) { assigned |= r == Ci; }); });
  if (!assigned) return hideUncoloured();
  if (beginsWithCopy(code_.body, Ci)) return;
  Block body = std::exchange(code_.body, {});
  initialise(Ci, number(0));
  code_.defaults += code_.body.size();
  code_.body.insert(code_.body.end(), std::make_move_iterator(body.begin()), std::make_move_iterator(body.end()));
}

// Shaders of rings assign nothing but Oi = 0 where they are invisible (RenderMan Companion, listing 16.26), and Cs must
// not show there.
void Lowering::hideUncoloured() {
  const int32_t Ci = global(Global::Ci), Oi = global(Global::Oi);
  bool clears = false;
  forEach(code_.body, [&](const Instruction& i) { forEachWrite(i, [&](int32_t r) { clears |= r == Oi; }); });
  if (!clears) return;
  const int32_t black = number(0), hidden = compute(Op::TripleEqual, {Oi, black});
  copy(Ci, compute(Op::Select, {hidden, black, Ci}, Shape::Triple));
}

// The host cannot give a value to a parameter that the shader writes (TM_OUTPUT). So an output becomes two parameters
// of one name, and starts with the value of the one that is given.
void Lowering::parameter(const Variable& v) {
  const bool stored = v.output && !v.type.isArray() && !v.type.is(Base::Matrix) && !v.type.is(Base::String);
  const int32_t output = stored ? outputParameter(v) : -1;
  givenParameter(v);
  code_.parameters.back().beginsOutput = v.output && v.assigned;
  if (!stored) return;
  const int32_t given = registers_[&v];
  initialise(output, given);
  if (v.assigned) registers_[&v] = output;
}

int32_t Lowering::outputParameter(const Variable& v) {
  Parameter p;
  p.name = v.name;
  p.type = v.type;
  p.output = true;
  p.place = v.place;
  const int32_t reg = variable(v);
  Register& r = code_.registers[static_cast<size_t>(reg)];
  r.origin = Origin::Parameter;
  r.index = static_cast<int32_t>(code_.parameters.size());
  code_.parameters.push_back(std::move(p));
  return reg;
}

void Lowering::givenParameter(const Variable& v) {
  Parameter p;
  p.name = v.name;
  p.type = v.type;
  p.detail = v.detail;
  p.place = v.place;
  if (p.type.length == kOpenArray) p.type.length = 1;
  const bool constantValue = constantDefault(v, p);
  const int32_t reg = variable(v);
  Register& r = code_.registers[static_cast<size_t>(reg)];
  r.origin = Origin::Parameter;
  r.index = static_cast<int32_t>(code_.parameters.size());
  r.length = p.type.length;
  p.computed = !constantValue;
  code_.parameters.push_back(std::move(p));
  if (!constantValue) computedDefault(v, reg);
}

// The default is lowered and folded like a shader of its own. If the result is one constant, that is the default that
// the host is told.
bool Lowering::constantDefault(const Variable& v, Parameter& p) {
  const auto width = static_cast<size_t>(std::max(1, p.type.length));
  const Shape of = shapeOf(v.type);
  if (of == Shape::Text)
    p.texts.assign(width, "");
  else
    p.floats.assign(width * static_cast<size_t>(floatsOf(of)), 0.0f);
  if (!v.initial) return true;
  std::vector<const Expr*> elements{v.initial.get()};
  if (v.initial->kind == ExprKind::Tuple && v.type.isArray()) {
    elements.clear();
    for (const ExprPtr& part : v.initial->args) elements.push_back(part.get());
  } else {
    elements.resize(width, v.initial.get());
  }
  bool constants = true;
  for (size_t k = 0; k < std::min(width, elements.size()); ++k) {
    Code scratch;
    scratch.kind = code_.kind;
    Messages later;  // dropped: the same messages come when the shader itself is lowered
    Lowering alone(scratch, later);
    const Expr& e = inShaderSpace(*elements[k]);
    const int32_t folded = foldConstants(scratch, alone.value(e, {v.type.base}));
    const Register& r = scratch.registers[static_cast<size_t>(folded)];
    if (r.origin != Origin::Constant || namesSpace(e)) {
      constants = false;
    } else if (of == Shape::Text) {
      p.texts[k] = r.texts[0];
    } else {
      const auto n = static_cast<size_t>(floatsOf(of));
      for (size_t c = 0; c < n; ++c) p.floats[k * n + c] = r.floats[r.floats.size() == 1 ? 0 : c];
      if (of == Shape::Matrix && r.floats.size() == 1)
        for (size_t c = 0; c < 15; ++c) p.floats[k * n + c] = c % 5 == 0 ? r.floats[0] : 0.0f;
    }
  }
  if (!constants) {
    std::fill(p.floats.begin(), p.floats.end(), kComputedNumber);
    std::fill(p.texts.begin(), p.texts.end(), kComputedText);
  }
  return constants;
}

// A scene may give only the first elements of an array, so the last one shows whether any is missing.
void Lowering::computedDefault(const Variable& v, int32_t reg) {
  if (!v.type.isArray()) return ifElse(isMissing(reg), block([&] { copy(reg, value(*v.initial, v.type)); }), {});
  const int32_t whole = add({.shape = shape(reg), .origin = Origin::Variable, .length = v.type.length});
  const auto missing = [&](int32_t at) { return isMissing(element(reg, at)); };
  const auto complete = [&] {
    initialiseArray(v, whole);
    for (int32_t k = 0; k < v.type.length && hasRoom(); ++k) {
      const int32_t at = number(static_cast<float>(k));
      ifElse(missing(at), block([&] { emit(Op::SetElement, {reg}, {at, element(whole, at)}); }), {});
    }
  };
  ifElse(missing(number(static_cast<float>(v.type.length - 1))), block(complete), {});
}

int32_t Lowering::isMissing(int32_t reg) {
  if (shape(reg) == Shape::Text) return compute(Op::TextEqual, {reg, text(kComputedText)});
  if (shape(reg) == Shape::Triple) return isMissing(compute(Op::Component, {reg, number(0)}));
  if (shape(reg) == Shape::Matrix) return isMissing(compute(Op::MatrixElement, {reg, number(0), number(0)}));
  return compute(Op::NotEqual, {reg, reg});  // only a NaN differs from itself
}

}  // namespace tomales::compiler

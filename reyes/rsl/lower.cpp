#include "reyes/rsl/lower.h"

#include <bit>

#include "reyes/rsl/lowering.h"

namespace tomales::compiler {

Shape shapeOf(const Type& type) {
  switch (type.base) {
    case Base::Void:
    case Base::Float:
      return Shape::Number;
    case Base::Matrix:
      return Shape::Matrix;
    case Base::String:
      return Shape::Text;
    default:
      return Shape::Triple;
  }
}

Lowering::Lowering(Code& code, Messages& messages) : code_(code), messages_(messages), block_(&code.body) {}

int32_t Lowering::add(Register r) {
  r.depth = depth_;
  code_.registers.push_back(std::move(r));
  return static_cast<int32_t>(code_.registers.size()) - 1;
}

int32_t Lowering::temporary(Shape shape) { return add({.shape = shape}); }

int32_t Lowering::number(float value) {
  const auto [it, isNew] = numbers_.try_emplace(value, -1);
  // Zero has two signs but one place in a map, and NaN has none.
  if (!isNew && std::bit_cast<uint32_t>(it->first) == std::bit_cast<uint32_t>(value)) return it->second;
  const int32_t reg = constant(Shape::Number, {value});
  if (isNew) it->second = reg;
  return reg;
}

int32_t Lowering::constant(Shape shape, std::vector<float> floats) {
  return add({.shape = shape, .origin = Origin::Constant, .varying = false, .floats = std::move(floats)});
}

int32_t Lowering::text(const std::string& value) {
  const auto [it, isNew] = texts_.try_emplace(value, -1);
  if (isNew) it->second = add({.shape = Shape::Text, .origin = Origin::Constant, .varying = false, .texts = {value}});
  return it->second;
}

int32_t Lowering::global(Global g) {
  const auto [it, isNew] = globals_.try_emplace(g, -1);
  if (!isNew) return it->second;
  const GlobalInfo& about = info(g);
  Register r{.shape = shapeOf({about.base}), .origin = Origin::Global, .varying = !about.uniform};
  r.name = about.name;
  r.index = static_cast<int32_t>(g);
  it->second = add(std::move(r));
  code_.registers[static_cast<size_t>(it->second)].depth = 0;
  return it->second;
}

int32_t Lowering::variable(const Variable& v) {
  Register r{.shape = shapeOf(v.type), .origin = Origin::Variable};
  r.length = v.type.length;
  r.name = v.name;
  r.declared = v.detail;
  r.place = v.place;
  return registers_[&v] = add(std::move(r));
}

bool Lowering::hasRoom() {
  if (++instructions_ == kMostInstructions)
    messages_.error(place_, "the shader is too large once its functions are inlined");
  return instructions_ <= kMostInstructions;
}

Instruction& Lowering::emit(Op op, std::vector<int32_t> out, std::vector<int32_t> in) {
  if (!hasRoom()) block_->clear();
  block_->push_back({.op = op, .out = std::move(out), .in = std::move(in), .place = place_});
  return block_->back();
}

int32_t Lowering::compute(Op op, std::vector<int32_t> in, Shape shape) {
  const char gives = info(op).signature[0];
  const int32_t out = temporary(gives == 'f'   ? Shape::Number
                                : gives == 't' ? Shape::Triple
                                : gives == 'm' ? Shape::Matrix
                                : gives == 's' ? Shape::Text
                                               : shape);
  emit(op, {out}, std::move(in));
  return out;
}

void Lowering::copy(int32_t to, int32_t from) { emit(Op::Copy, {to}, {from}); }

void Lowering::initialise(int32_t to, int32_t from) { emit(Op::Copy, {to}, {from}).masked = false; }

Code lower(const Checked&, const Shader& shader, Messages& messages, bool onGeometry) {
  Code code;
  code.onGeometry = onGeometry;
  Lowering(code, messages).shader(shader);
  return code;
}

}  // namespace tomales::compiler

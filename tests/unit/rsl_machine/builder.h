// Code written by hand: registers and instructions, blocks by functions.
#pragma once
#include <functional>
#include <utility>

#include "reyes/rsl/code.h"

namespace tomales::compiler {

class Builder {
 public:
  explicit Builder(ShaderKind kind = ShaderKind::Surface) {
    code.kind = kind;
    code.name = "built";
    blocks_ = {&code.body};
  }
  Builder(const Builder&) = delete;
  using Body = std::function<void()>;

  int32_t add(Register r) {
    code.registers.push_back(std::move(r));
    return static_cast<int32_t>(code.registers.size()) - 1;
  }
  int32_t number(float x) { return add({.origin = Origin::Constant, .varying = false, .floats = {x}}); }
  int32_t numbers(std::vector<float> x) {
    const auto n = static_cast<int32_t>(x.size());
    return add({.origin = Origin::Constant, .varying = false, .length = n, .floats = std::move(x)});
  }
  int32_t triple(float x, float y, float z) {
    return add({.shape = Shape::Triple, .origin = Origin::Constant, .varying = false, .floats = {x, y, z}});
  }
  int32_t text(std::string t) {
    return add({.shape = Shape::Text, .origin = Origin::Constant, .varying = false, .texts = {std::move(t)}});
  }
  int32_t variable(Shape shape = Shape::Number, bool varying = true, int32_t length = 0) {
    return add(
        {.shape = shape, .origin = Origin::Variable, .varying = varying && shape != Shape::Text, .length = length});
  }
  int32_t temporary(Shape shape = Shape::Number, bool varying = true) {
    return add({.shape = shape, .origin = Origin::Temporary, .varying = varying && shape != Shape::Text});
  }
  int32_t global(const std::string& name, Shape shape, bool varying = true) {
    return add({.shape = shape, .origin = Origin::Global, .varying = varying, .name = name});
  }
  int32_t parameter(const std::string& name, Base base, std::vector<float> value, bool output = false,
                    bool varying = true) {
    const Shape shape = base == Base::Float    ? Shape::Number
                        : base == Base::String ? Shape::Text
                        : base == Base::Matrix ? Shape::Matrix
                                               : Shape::Triple;
    const auto length = static_cast<int32_t>(value.size()) / std::max(1, floatsOf(shape));
    Parameter p;
    p.name = name;
    p.type = {base, length > 1 ? length : 0};
    p.output = output;
    p.floats = std::move(value);
    code.parameters.push_back(p);
    return add({.shape = shape,
                .origin = Origin::Parameter,
                .varying = varying && shape != Shape::Text,
                .length = p.type.length,
                .name = name,
                .index = static_cast<int32_t>(code.parameters.size()) - 1});
  }

  Instruction& emit(Op op, std::vector<int32_t> out, std::vector<int32_t> in, int32_t extra = 0) {
    Instruction i{op, std::move(out), std::move(in), extra};
    blocks_.back()->push_back(std::move(i));
    return blocks_.back()->back();
  }
  /// The result is a new temporary.
  int32_t value(Op op, std::vector<int32_t> in, Shape shape = Shape::Number, bool varying = true) {
    const int32_t out = temporary(shape, varying);
    emit(op, {out}, std::move(in));
    return out;
  }
  void copy(int32_t to, int32_t from) { emit(Op::Copy, {to}, {from}); }

  void branch(int32_t condition, const Body& body, const Body& other = {}) {
    std::vector<Body> all{body};
    if (other) all.push_back(other);
    nest(Op::If, {condition}, 0, all);
  }
  /// `condition` writes the register `holds`.
  void loop(
      int32_t holds, int32_t label, const Body& condition, const Body& body, const Body& step = [] {}) {
    nest(Op::Loop, {holds}, label, {condition, body, step});
  }
  void scope(int32_t label, const Body& body) { nest(Op::Scope, {}, label, {body}); }
  void leave(int32_t label) { emit(Op::Leave, {}, {}, label); }
  /// Adds an instruction with blocks, such as Illuminance.
  void nest(Op op, std::vector<int32_t> in, int32_t extra, const std::vector<Body>& bodies,
            std::vector<int32_t> out = {}, std::vector<Setting> settings = {}) {
    Instruction i{op, std::move(out), std::move(in), extra, std::move(settings)};
    for (const Body& body : bodies) {
      Block block;
      blocks_.push_back(&block);
      body();
      blocks_.pop_back();
      i.blocks.push_back(std::move(block));
    }
    blocks_.back()->push_back(std::move(i));
  }
  int32_t label(int32_t count = 1) { return std::exchange(code.labels, code.labels + count); }

  Code code;

 private:
  std::vector<Block*> blocks_;
};

}  // namespace tomales::compiler

// What a shader is compiled to: structured three-address code over registers, one for the whole batch of points.
// An instruction works on all points at once; conditions become masks (machine/). Immutable once compiled, shared by
// threads.
#pragma once
#include <string>
#include <vector>

#include "reyes/rsl/ops.h"
#include "reyes/rsl/tree.h"

namespace tomales::compiler {

enum class Shape : uint8_t { Number, Triple, Matrix, Text };
constexpr int floatsOf(Shape s) {
  return s == Shape::Number ? 1 : s == Shape::Triple ? 3 : s == Shape::Matrix ? 16 : 0;
}

enum class Origin : uint8_t {
  Temporary,  ///< Written by one instruction, before all that read it.
  Variable,   ///< Written by any.
  Constant,   ///< floats or texts.
  Global,     ///< `name` is one of the shader's kind (globals.h); holds the batch's value at first.
  Parameter,  ///< `index` of Code::parameters; holds its value at first.
};

struct Register {
  Shape shape = Shape::Number;
  Origin origin = Origin::Temporary;
  bool varying = true;  ///< False: one value for the batch. Texts never vary.
  int32_t length = 0;   ///< Elements of an array; 0: no array.
  std::string name{};   ///< Of what is written in the source; empty: a temporary.
  int32_t index = -1;
  std::vector<float> floats{};  ///< Of a constant: element by element, component by component.
  std::vector<std::string> texts{};
  int32_t depth = 0;  ///< How many control structures are around its declaration.
  Detail declared = Detail::Unstated;
  Place place{};  ///< Of the declaration.
  int32_t slot =
      -1;  ///< Where the machine keeps it, in floats for each point (varying) or value (uniform): passes/allocate.h.
};

/// An entry of an optional list: trace(P, R, "samples", 16).
struct Setting {
  int32_t name = -1;  ///< A register of text.
  int32_t value = -1;
  bool fills = false;       ///< `value` is an output.
  Base base = Base::Float;  ///< What the value is in the source: a color is not a point to gather().
};

struct Instruction;
using Block = std::vector<Instruction>;

struct Instruction {
  Op op;
  std::vector<int32_t> out, in;  ///< Registers, in the order of the signature; -1: left out.
  int32_t extra = 0;
  std::vector<Setting> settings{};
  std::vector<Block> blocks{};
  Place place{};
  bool masked = true;  ///< False: all points of the batch are active here, whatever the shader does.
};

struct Parameter {
  std::string name;
  Type type;
  Detail detail = Detail::Unstated;
  bool output = false;        ///< The host takes what becomes of it, a number or triple, and gives nothing.
  std::vector<float> floats;  ///< The default, where it is a constant; in shader space.
  std::vector<std::string> texts;
  /// The default is computed when the shader runs and nothing is given: `floats` is kNotGiven then.
  bool computed = false;
  Place place{};
};

struct Code {
  ShaderKind kind = ShaderKind::Surface;
  std::string name, doc, path;
  std::vector<Register> registers;
  std::vector<Parameter> parameters;
  Block body;
  int32_t labels = 0;
  uint32_t capabilities = 0;                     ///< TmCapability, found by analysis (passes/capabilities.h).
  int32_t varyingFloats = 0, uniformFloats = 0;  ///< What the machine needs: slots of both kinds.
};

/// One instruction a line, indented, registers by number and name.
std::string dump(const Code& code);

}  // namespace tomales::compiler

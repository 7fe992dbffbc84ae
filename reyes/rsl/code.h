// The compiled form of a shader: structured three-address code over registers, the same for the whole batch of points.
// An instruction works on all points at once; conditions become masks (machine/). Code is constant once it is compiled,
// and threads share it.
#pragma once
#include <string>
#include <vector>

#include "reyes/rsl/builtins.h"
#include "reyes/rsl/ops.h"
#include "reyes/rsl/tree.h"

namespace tomales::compiler {

enum class Shape : uint8_t { Number, Triple, Matrix, Text };
constexpr int floatsOf(Shape s) {
  return s == Shape::Number ? 1 : s == Shape::Triple ? 3 : s == Shape::Matrix ? 16 : 0;
}

enum class Origin : uint8_t {
  Temporary,  ///< Written by one instruction, before all that read it.
  Variable,   ///< Written by any number of instructions.
  Constant,   ///< Its value is in `floats` or `texts`.
  Global,     ///< `name` is a global of the shader's kind (globals.h); the register holds the batch's value at first.
  Parameter,  ///< `index` is an index in Code::parameters; the register holds the parameter's value at first.
};

/// The most bytes of a text at run time.
inline constexpr size_t kLongestText = 1 << 20;

struct Register {
  Shape shape = Shape::Number;
  Origin origin = Origin::Temporary;
  bool varying = true;  ///< False if the batch has one value. Texts never vary.
  int32_t length = 0;   ///< The number of elements of an array; 0 if it is none.
  std::string name{};   ///< The name in the source; empty for a temporary.
  int32_t index = -1;
  std::vector<float> floats{};  ///< The value of a constant, element by element, component by component.
  std::vector<std::string> texts{};
  int32_t depth = 0;  ///< The number of control structures around its declaration.
  Detail declared = Detail::Unstated;
  Place place{};  ///< Place of its declaration.
  /// Place in the machine, in floats for each point (varying) or value (uniform): passes/passes.h.
  int32_t slot = -1;
};

/// An entry of an optional list: trace(P, R, "samples", 16).
struct Setting {
  int32_t name = -1;  ///< A register that holds a text.
  int32_t value = -1;
  bool fills = false;       ///< True if `value` is an output.
  Base base = Base::Float;  ///< The type in the source: gather() tells a color from a point.
};

struct Instruction;
using Block = std::vector<Instruction>;

struct Instruction {
  Op op;
  std::vector<int32_t> out, in;  ///< Registers in the order of the signature; -1 for an argument that is left out.
  int32_t extra = 0;
  std::vector<Setting> settings{};
  std::vector<Block> blocks{};
  Place place{};
  bool masked = true;  ///< False if all points of the batch are active here, whatever the shader does.
};

struct Parameter {
  std::string name;
  Type type;
  Detail detail = Detail::Unstated;
  bool output = false;        ///< True if the host only reads its value, a number or triple, and sets none.
  std::vector<float> floats;  ///< The default in shader space, if it is constant.
  std::vector<std::string> texts;
  bool beginsOutput = false;  ///< See kBeginsOutput in reyes/rsl_host.h.
  /// True if the shader computes the default when it is given no value: `floats` and `texts` then are the marks of
  /// reyes/computed_default.h.
  bool computed = false;
  bool told = false;  ///< True in the code of a default (defaultOf()): the value is what the code is run for.
  Place place{};
};

/// Half of pi, with room for the rounding of what a scene or a shader writes.
constexpr float kRightAngle = 1.570797f;

struct Code {
  ShaderKind kind = ShaderKind::Surface;
  std::string name, doc, path;
  std::vector<Register> registers;
  std::vector<Parameter> parameters;
  std::vector<const Builtin*> plugins;  ///< The functions that Op::Plugin calls.
  Block body;
  size_t defaults = 0;  ///< Number of instructions at the beginning of `body`, as lowered, that give parameters values.
  int32_t labels = 0;
  bool asksPlace = false;                        ///< True for a light that reads P, its own place.
  bool onGeometry = false;                       ///< True if the host gives P, on the geometry of AreaLightSource.
  bool allRound = false;                         ///< True for a light that may shine to the back of its geometry.
  int32_t cone = -1;                             ///< The register of the widest cone that is computed; -1: none is.
  uint32_t capabilities = 0;                     ///< TmCapability, found by analysis (passes/passes.h).
  int32_t varyingFloats = 0, uniformFloats = 0;  ///< The slots of both kinds that the machine needs.
};

/// Returns one line for each instruction, indented, with registers by number and name.
std::string dump(const Code& code);

}  // namespace tomales::compiler

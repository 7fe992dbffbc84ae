// A compiled shader that is ready to run, with everything about its code that can be found without a batch. It is
// constant, and threads share it.
#pragma once
#include "reyes/base/simd.h"
#include "reyes/rsl/code.h"
#include "reyes/rsl/kernels.h"

namespace tomales::compiler {

struct Run;
struct PreparedInstruction;
using PreparedBlock = std::vector<PreparedInstruction>;
using Execute = void (*)(Run&, const PreparedInstruction&);

/// An instruction, with the values that would otherwise be looked up each time.
struct PreparedInstruction {
  Execute execute = nullptr;
  Kernel kernel = nullptr;
  const Instruction* of = nullptr;
  int32_t out = -1;        ///< The first result.
  int32_t in[4] = {};      ///< The first operands.
  int32_t components = 1;  ///< The number of components of the result, where a kernel does one at a time.
  int32_t component = 0;   ///< The component that Op::Component reads, where that is constant.
  bool uniform = false;    ///< The result is one value for the batch.
  bool left[2] = {};       ///< Whether a Leave names the label `extra`, or `extra` + 1, of this Scope or Loop.
  std::vector<PreparedBlock> blocks;
};

/// The place of a register.
enum class Where : uint8_t {
  Nowhere,   ///< Nothing uses it.
  Constant,  ///< It lies `at` floats behind the program's first constant.
  Varying,   ///< It lies `at` floats for each point behind the run's first.
  Uniform,   ///< It lies `at` values behind the run's first.
  Given,     ///< The grid's arrays are used if possible; otherwise it is as Varying.
  Texts,     ///< The run's text number `at`; a constant is a text of the code.
};
struct Located {
  Where where = Where::Nowhere;
  bool assigned = false;  ///< Some instruction writes it.
  bool partly = false;    ///< Some instruction writes it at active points alone.
  bool once = false;      ///< Exactly one instruction writes it.
  bool opens = true;      ///< Its first value may be read.
  int32_t at = 0;
  int32_t global = -1;  ///< The Global (globals.h), or -1.
};

class Program {
 public:
  /// Pre: all passes have run over the code. (Registers without a slot get room of their own.)
  explicit Program(Code code);
  Program(const Program&) = delete;

  const Code& code() const { return code_; }
  const Register& reg(int32_t r) const { return code_.registers[static_cast<size_t>(r)]; }
  const Located& located(int32_t r) const { return located_[static_cast<size_t>(r)]; }
  const float* constants() const { return constants_.data(); }
  const PreparedBlock& body() const { return body_; }
  /// The registers that hold numbers and are used.
  struct Numbers {
    int32_t reg, at;
    Where where;
    bool several;  ///< They have more than one component.
  };
  const std::vector<Numbers>& numbers() const { return numbers_; }
  /// Returns the globals and parameters that are used, in the order of their numbers.
  const std::vector<int32_t>& ofHost() const { return ofHost_; }
  /// Registers that may be read before they are written, as a range [from, to) of floats for each point (varying) or of
  /// values (uniform).
  struct Cleared {
    bool varying;
    int32_t from, to;
  };
  const std::vector<Cleared>& cleared() const { return cleared_; }
  int32_t varyingFloats() const { return varying_; }
  int32_t uniformFloats() const { return uniform_; }
  int32_t texts() const { return texts_; }

 private:
  void find(const Block& block);
  void findOverwritten();
  void locate();
  PreparedBlock prepared(const Block& block) const;
  Code code_;
  std::vector<Located> located_;
  std::vector<bool> used_, left_;  // by register; by label
  AlignedVector<float> constants_;
  std::vector<Cleared> cleared_;
  std::vector<Numbers> numbers_;
  std::vector<int32_t> ofHost_;
  PreparedBlock body_;
  int32_t varying_ = 0, uniform_ = 0, texts_ = 0;
};

/// Returns the number of floats of one element.
inline int32_t floatsOf(const Register& r) { return floatsOf(r.shape); }
inline int32_t elementsOf(const Register& r) { return r.length > 0 ? r.length : 1; }

}  // namespace tomales::compiler

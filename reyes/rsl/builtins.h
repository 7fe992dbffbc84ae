// RSL's built-in functions: one table of their names and types, and of the instructions that they become. The checker
// chooses among its rows, the lowering reads from it what to emit, and a test compares docs/rsl_reference.md with it.
// Functions that are simpler to write in RSL itself are in the prelude (prelude.cpp).
#pragma once
#include <span>
#include <string>
#include <vector>

#include "reyes/rsl/ops.h"
#include "reyes/rsl/tree.h"
#include "reyes/shader/functions.h"

namespace tomales::compiler {

/// The way in which a call becomes code. Instruction is `op` on the arguments in order; lower_calls.cpp does the
/// others.
enum class Emit : uint8_t {
  Instruction,
  Fold,          ///< `op` applied repeatedly: min(a, b, c).
  Component,     ///< `number` is the component: xcomp()
  SetComponent,  ///< `number` is the component; the first argument is assigned.
  Derivative,    ///< `op` over du or dv.
  Normal,        ///< calculatenormal()
  Spline,
  Transform,  ///< transform(), vtransform(), ntransform(); `number`: TmTransformKind
  ColorTransform,
  Texture,
  Environment,
  Shadow,
  List,    ///< `op` on the arguments, with an optional list.
  Traced,  ///< `op` on the arguments, with a list; numbers of samples may be left out.
  Ask,     ///< `number`: TmWhom; the last argument is filled in
  ShaderName,
  Print,
  ArrayLength,
  Plugin,  ///< The function of a plugin.
};

/// The arguments that a parameter takes.
struct Slot {
  Base base = Base::Float;
  bool any = false;     ///< True if it takes any type.
  bool output = false;  ///< True if the argument must be a variable or an element of an array.
  bool array = false;
};

struct Builtin {
  std::string name;
  Base result = Base::Void;
  std::vector<Slot> slots;
  bool more = false;  ///< Further arguments follow: an optional list, or values of the last slot's type.
  Op op{};
  Emit emit = Emit::Instruction;
  float number = 0;
  const TmFunction* plugin = nullptr;  ///< Null for a function of the language.
};

/// Makes the row of a plugin's function. Returns nothing if its prototype cannot be read, or names a type that plugin
/// functions cannot have.
std::optional<Builtin> builtinOf(const TmFunction& function);

/// Returns all rows. Those of one name are together.
std::span<const Builtin> builtins();
/// Returns the rows of a name: [first, first + count) of builtins(). The count is 0 if there is none.
std::pair<int32_t, int32_t> rowsOf(std::string_view name);

}  // namespace tomales::compiler

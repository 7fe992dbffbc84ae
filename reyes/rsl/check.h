// The third stage of the compiler finds what names mean and what types expressions have. It fills in Expr::type,
// variable, function and builtin, chooses among functions of one name, and reports what is wrong or suspicious.
#pragma once
#include <deque>

#include "reyes/rsl.h"
#include "reyes/rsl/builtins.h"
#include "reyes/rsl/tree.h"

namespace tomales::compiler {

/// A checked file. Trees point into `globals`, and into the prelude.
struct Checked {
  File file;
  std::deque<Variable> globals;     ///< Globals in the order of the table (globals.h).
  std::deque<Builtin> ofPlugins{};  ///< The plugin functions that the file calls.
};

/// Returns the functions that are written in RSL and known to all shaders. They are checked once. Any thread may call
/// this.
const Checked& prelude();

/// Checks a file. Errors and warnings go to `messages`; if there are errors, the result must not be lowered. `plugins`
/// is null if there are no plugin functions.
Checked check(File file, Messages& messages, const RslFunctions* plugins = nullptr);

/// Tells whether that name of an optional list takes a variable to fill in, as in gather(..., "surface:Ci", C).
bool isFilled(std::string_view function, std::string_view name);

}  // namespace tomales::compiler

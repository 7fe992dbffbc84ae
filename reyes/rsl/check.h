// The third stage finds what names mean and what types expressions have. It fills in Expr::type, variable, function and
// builtin, chooses among functions of one name, and reports what is wrong or suspicious.
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
  std::deque<Builtin> ofPlugins{};  ///< The functions of plugins that the file calls.
};

/// Functions that are written in RSL and known to all shaders. They are checked once. Any thread may call this.
const Checked& prelude();

/// Errors and warnings go to `messages`; where there are errors the result is not to be lowered.
/// `plugins` is null if there are no functions but those of the language and of the file.
Checked check(File file, Messages& messages, const RslFunctions* plugins = nullptr);

/// Tells whether that name of an optional list has a variable to fill in, as gather(..., "surface:Ci", C) has.
bool isFilled(std::string_view function, std::string_view name);

}  // namespace tomales::compiler

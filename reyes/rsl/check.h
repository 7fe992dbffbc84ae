// The third stage: what names mean and what types expressions have. It fills in Expr::type, variable, function and
// builtin, chooses among functions of one name, and tells what is wrong and what is suspicious.
#pragma once
#include <deque>

#include "reyes/rsl/builtins.h"
#include "reyes/rsl/tree.h"

namespace tomales::compiler {

/// A checked file. Trees point into `globals`, and into the prelude.
struct Checked {
  File file;
  std::deque<Variable> globals;  ///< In the order of the table (globals.h).
};

/// Functions that are written in RSL and known to all shaders, checked once. Threads: any.
const Checked& prelude();

/// Errors and warnings go to `messages`; where there are errors the result is not to be lowered.
Checked check(File file, Messages& messages);

/// Which of the names of an optional list is filled in: gather(..., "surface:Ci", C). `function`: "gather", ...
bool isFilled(std::string_view function, std::string_view name);

}  // namespace tomales::compiler

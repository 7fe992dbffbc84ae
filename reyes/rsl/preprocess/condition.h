// The integer expressions of #if (C90 6.8.1).
#pragma once
#include <vector>

#include "reyes/rsl/preprocess/lexer.h"

namespace tomales::compiler {

/// Tells whether the expression is not 0; false after an error. Macros must be replaced already, and 'defined' done;
/// other names are 0. Messages stand at `directive` if no word of the expression is to blame.
bool holds(const std::vector<Lexeme>& expression, Place directive, Messages& messages);

}  // namespace tomales::compiler

// The integer expressions of #if (C90 6.8.1).
#pragma once
#include <vector>

#include "reyes/rsl/preprocess/lexer.h"

namespace tomales::compiler {

/// Tells whether the expression is not 0; false after an error. Pre: macros and 'defined' have been replaced; remaining
/// names are 0. A message has the place `directive` if no word of the expression is to blame.
bool holds(const std::vector<Lexeme>& expression, Place directive, Messages& messages);

}  // namespace tomales::compiler

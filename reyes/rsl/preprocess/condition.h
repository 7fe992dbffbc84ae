// The integer expressions of #if (C90 6.8.1).
#pragma once
#include <vector>

#include "reyes/rsl/preprocess/lexer.h"

namespace tomales::compiler {

/// Whether the expression is not 0. Macros are replaced already, and 'defined' is done; other names are 0.
/// `directive`: where a message stands that no word of the expression can be blamed for. False after an error.
bool holds(const std::vector<Lexeme>& expression, Place directive, Messages& messages);

}  // namespace tomales::compiler

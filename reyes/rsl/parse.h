// The second stage: tokens become trees. Recursive descent; RISpec 3.2 section 11 to 14 and what public shaders
// write besides.
#pragma once
#include "reyes/rsl/preprocess.h"
#include "reyes/rsl/tree.h"

namespace tomales::compiler {

/// More levels of brackets, statements or functions are an error, so that no input exhausts the stack.
constexpr int kMostNesting = 400;

/// After an error the parser goes on at the next statement, so that one run finds several.
File parse(const std::vector<Token>& tokens, Messages& messages);

}  // namespace tomales::compiler

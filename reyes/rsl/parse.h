// The second stage: tokens become trees. Recursive descent, for RISpec 3.2 sections 11 to 14 and further forms that
// public shaders use.
#pragma once
#include "reyes/rsl/preprocess.h"
#include "reyes/rsl/tree.h"

namespace tomales::compiler {

/// Most levels of brackets, statements or functions. More are an error, so that no input exhausts the stack.
constexpr int kMostNesting = 400;

/// After an error the parser goes on at the next statement, so that one run finds several.
File parse(const std::vector<Token>& tokens, Messages& messages);

}  // namespace tomales::compiler

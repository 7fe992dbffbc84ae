// The rules of RSL's types: what converts to what, and what operators give (RISpec 3.2 sections 11.2 and 14.1).
#pragma once
#include <optional>

#include "reyes/rsl/ops.h"
#include "reyes/rsl/tree.h"

namespace tomales::compiler {

/// Of an expression with an error, which has been told: it goes with everything.
constexpr Type kUnknown{Base::Void, -2};

inline bool isSpatial(const Type& t) { return t.isTriple() && t.base != Base::Color; }
inline bool isNumeric(const Type& t) { return t.is(Base::Float) || t.isTriple(); }

/// How far apart two types are: 0 the same; empty: one does not convert to the other. More than kDoubtful is taken
/// with a warning: a color where a point belongs, which RISpec does not have and public shaders do.
constexpr int kDoubtful = 5;
std::optional<int> conversion(const Type& from, const Type& to);

struct Operation {
  Op op;
  Type result;
  Type operand = kUnknown;  ///< What both sides are converted to; unknown: left as they are.
  bool negated = false;     ///< The instruction gives the opposite.
};
/// Of a binary operator; empty: there is none for these types.
std::optional<Operation> binaryOperation(std::string_view text, const Type& left, const Type& right);

}  // namespace tomales::compiler

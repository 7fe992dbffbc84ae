// The rules of RSL's types: conversions, and the results of operators (RISpec 3.2 sections 11.2 and 14.1).
#pragma once
#include <optional>

#include "reyes/rsl/ops.h"
#include "reyes/rsl/tree.h"

namespace tomales::compiler {

/// The type of an expression with an error that has been reported: it converts to everything.
constexpr Type kUnknown{Base::Void, -2};

inline bool isSpatial(const Type& t) { return t.isTriple() && t.base != Base::Color; }
inline bool isNumeric(const Type& t) { return t.is(Base::Float) || t.isTriple(); }

/// Returns how far apart two types are: 0 if they are the same, nothing if `from` does not convert to `to`. A distance
/// above kDoubtful gives a warning, for example for a color in the place of a point, which RISpec forbids and public
/// shaders use.
constexpr int kDoubtful = 5;
std::optional<int> conversion(const Type& from, const Type& to);

struct Operation {
  Op op;
  Type result;
  Type operand = kUnknown;  ///< The type that both sides are converted to; kUnknown if they are not converted.
  bool negated = false;     ///< True if the result is the opposite of the instruction's.
};
/// Returns the operation of a binary operator; empty if there is none for these types.
std::optional<Operation> binaryOperation(std::string_view text, const Type& left, const Type& right);

}  // namespace tomales::compiler

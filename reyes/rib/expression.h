// Evaluates the conditions of IfBegin and ElseIf, and replaces ${name} in strings.
#pragma once
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

namespace tomales::rib {

/// Returns the value of a variable, or nothing if there is none of that name.
using Variables = std::function<std::optional<std::string>(const std::string& name)>;

/// The most bytes of strings that variables and concat() may make in one request. Without this limit a file of 2 KB
/// could double a string again and again, to any length.
constexpr size_t kLongestText = 1 << 20;

struct ExpressionError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Evaluates a condition. Every value is a string; one that reads as a number is compared, added and tested as that
/// number. The operators, from the loosest, are:
///   ||   &&   == != < <= > >= =~ (a pattern with * and ?)   + -   * /   ! -   and then
///   1.5   'text'   word   $name   ${name}   $(expression)   (expression)   defined(name)   concat(a, b, ...)
/// Throws ExpressionError.
bool holds(const std::string& expression, const Variables& variables);

/// Replaces MARK{name}. A name that has no value stays as it is, and is appended to `unknown`. Throws ExpressionError
/// if the result were longer than kLongestText.
std::string substitute(const std::string& text, char mark, const Variables& variables, std::string& unknown);

}  // namespace tomales::rib

// Checks of our own code's invariants: a failed one prints both operands and aborts. Bad input is reported by log.h
// instead.
#pragma once
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

namespace tomales {
template <class A, class B>
[[noreturn]] void checkFailed(const char* file, int line, const char* text, const A& a, const B& b) {
  std::fputs(fmt::format("{}:{}: broken promise: {} ({} against {})\n", file, line, text, a, b).c_str(), stderr);
  std::abort();
}
}  // namespace tomales

#define TOMALES_CHECK_OP(a, op, b)                                                            \
  do {                                                                                        \
    if (!((a)op(b))) ::tomales::checkFailed(__FILE__, __LINE__, #a " " #op " " #b, (a), (b)); \
  } while (0)
#define CHECK_EQ(a, b) TOMALES_CHECK_OP(a, ==, b)
#define CHECK_LT(a, b) TOMALES_CHECK_OP(a, <, b)
#define CHECK_LE(a, b) TOMALES_CHECK_OP(a, <=, b)
#define CHECK_GE(a, b) TOMALES_CHECK_OP(a, >=, b)

// RSL's shadeops on strings (RISpec 15.5): concat, format, match. Strings are uniform.
#pragma once
#include <regex.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "reyes/shader/shadeops.h"

namespace rsl {

namespace text_detail {

inline std::string written(float x) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%f", static_cast<double>(x));
  return buffer;
}
inline std::string written(int x) { return std::to_string(x); }
inline std::string written(double x) { return written(static_cast<float>(x)); }
inline std::string written(const char* s) { return s; }
inline std::string written(const std::string& s) { return s; }
inline std::string written(Vec3 v) { return written(v.x) + " " + written(v.y) + " " + written(v.z); }
inline std::string written(const Matrix& m) {
  std::string out;
  for (const auto& row : m.m)
    for (const float x : row) out += (out.empty() ? "" : " ") + written(x);
  return out;
}

}  // namespace text_detail

template <class... Parts>
std::string concat(const Parts&... parts) {
  return (std::string() + ... + parts);
}

/// %f stands for a float, %d for a number without its fraction, %c for a colour, %p for a point, vector or normal, %m
/// for a matrix, %s for a string. A value is written by its own type, even if the letter differs. %% is a percent sign.
/// A letter for which no value is left stays as it is. `values` are already converted to texts.
inline std::string formatTexts(const std::string& pattern, const std::vector<std::string>& values) {
  std::string out;
  size_t next = 0;
  for (size_t i = 0; i < pattern.size(); ++i) {
    const bool letter = pattern[i] == '%' && i + 1 < pattern.size();
    if (letter && pattern[i + 1] != '%' && next < values.size()) {
      const std::string& value = values[next++];
      const bool whole = pattern[++i] == 'd' && value.find_first_not_of("-0123456789.") == value.npos;
      out += whole ? value.substr(0, value.find('.')) : value;
    } else {
      out += pattern[i];
      i += letter && pattern[i + 1] == '%';
    }
  }
  return out;
}
template <class... Values>
std::string format(const std::string& pattern, const Values&... values) {
  return formatTexts(pattern, {text_detail::written(values)...});
}

namespace text_detail {
/// Returns the larger number of the repetition that begins at `at` ("{2,5}": 5; "{2,}": 2), or 1 if none begins there.
inline double repetitions(const std::string& pattern, size_t at) {
  const size_t end = pattern.find_first_not_of("0123456789,", at + 1);
  if (end == pattern.npos || pattern[end] != '}') return 1;
  double most = 1, number = 0;
  while (++at < end) {
    number = pattern[at] == ',' ? 0 : 10 * number + (pattern[at] - '0');
    most = std::max(most, number);
  }
  return most;
}
}  // namespace text_detail

/// Tells whether an extended regular expression is so long, or has such nested repetitions ("((a{255}){255}){255}"),
/// that compiling it might exhaust memory. Characters are counted with their repetitions. The count is never too low: a
/// repetition of more than one character multiplies everything before it.
inline bool isHugePattern(const std::string& pattern) {
  constexpr size_t kLongest = 4096;
  constexpr double kMostCharacters = 1 << 16;
  if (pattern.size() > kLongest) return true;
  double characters = 0;
  for (size_t i = 0; i < pattern.size(); ++i, ++characters) {
    if (pattern[i] != '{' || i == 0) continue;
    const double times = text_detail::repetitions(pattern, i);
    const bool ofOne = std::string_view(")}*+?").find(pattern[i - 1]) == std::string_view::npos;
    characters = ofOne ? characters + times - 1 : characters * times;
  }
  return characters > kMostCharacters;
}

/// Tells whether an extended regular expression matches any part of the text. A malformed or huge expression matches
/// nothing.
inline bool match(const std::string& pattern, const std::string& text) {
  regex_t expression;
  if (isHugePattern(pattern) || regcomp(&expression, pattern.c_str(), REG_EXTENDED | REG_NOSUB) != 0) return false;
  const bool fits = regexec(&expression, text.c_str(), 0, nullptr, 0) == 0;
  regfree(&expression);
  return fits;
}

}  // namespace rsl

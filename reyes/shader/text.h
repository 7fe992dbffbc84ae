// RSL's shadeops on strings (RISpec 15.5): concat, format, match. Strings are uniform.
#pragma once
#include <regex.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reyes/shader/shadeops.h"

namespace rsl {

/// A value of format(): a text, or the numbers of a float, a triple or a matrix.
struct FormatValue {
  std::string text;
  std::vector<double> numbers;
  bool whole = false;  ///< The number is of a whole type, and is written without a fraction.
};

namespace text_detail {

inline FormatValue valueOf(double x) { return {{}, {x}}; }
inline FormatValue valueOf(float x) { return valueOf(static_cast<double>(x)); }
inline FormatValue valueOf(int x) { return {{}, {static_cast<double>(x)}, true}; }
inline FormatValue valueOf(const std::string& s) { return {s, {}}; }
inline FormatValue valueOf(Vec3 v) { return {{}, {v.x, v.y, v.z}}; }
inline FormatValue valueOf(const Matrix& m) {
  FormatValue out;
  for (const auto& row : m.m) out.numbers.insert(out.numbers.end(), std::begin(row), std::end(row));
  return out;
}

/// What a pattern says about one value, such as "%-8.3f". Widths and precisions are bounded, because patterns come from
/// strangers.
struct Layout {
  bool left = false, zeros = false, plus = false;
  int width = 0, precision = -1;
  char letter = 0;  ///< 0: there is none of those that stand for values
  size_t end = 0;   ///< the place behind the letter
};

inline Layout layoutAt(const std::string& pattern, size_t percent) {
  constexpr int kMost = 200;
  constexpr std::string_view kLetters = "fdicpvnmsheEgG";
  Layout out;
  size_t i = percent + 1;
  const auto number = [&] {
    int n = 0;
    for (; i < pattern.size() && pattern[i] >= '0' && pattern[i] <= '9'; ++i)
      n = std::min(10 * n + (pattern[i] - '0'), kMost);
    return n;
  };
  for (; i < pattern.size() && std::string_view("-0+ #").find(pattern[i]) != std::string_view::npos; ++i) {
    out.left |= pattern[i] == '-';
    out.zeros |= pattern[i] == '0';
    out.plus |= pattern[i] == '+';
  }
  out.width = number();
  if (i < pattern.size() && pattern[i] == '.') {
    ++i;
    out.precision = number();
  }
  while (i < pattern.size() && (pattern[i] == 'l' || pattern[i] == 'L')) ++i;  // "%ld", as in C
  if (i < pattern.size() && kLetters.find(pattern[i]) != std::string_view::npos) out.letter = pattern[i];
  out.end = i + 1;
  return out;
}

inline std::string padded(std::string text, const Layout& layout, bool zeros) {
  const auto width = static_cast<size_t>(layout.width);
  if (text.size() >= width) return text;
  const bool hasSign = zeros && !text.empty() && (text[0] == '-' || text[0] == '+');
  const size_t at = layout.left ? text.size() : hasSign ? 1 : 0;
  text.insert(at, width - text.size(), zeros && !layout.left ? '0' : ' ');
  return text;
}

inline std::string laidOut(double x, bool isWhole, const Layout& layout) {
  const bool whole = isWhole || layout.letter == 'd' || layout.letter == 'i';
  const int digits = whole ? 0 : layout.precision < 0 ? 6 : layout.precision;
  const double value = whole ? std::trunc(x) + 0.0 : x;
  char buffer[512];
  if (layout.letter == 'g' || layout.letter == 'G')
    std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  else if (layout.letter == 'e' || layout.letter == 'E')
    std::snprintf(buffer, sizeof buffer, "%.*e", digits, value);
  else
    std::snprintf(buffer, sizeof buffer, "%.*f", digits, value);
  std::string text = buffer;
  if (layout.plus && text[0] != '-') text.insert(0, "+");
  return padded(std::move(text), layout, layout.zeros && std::isfinite(x));
}

inline std::string laidOut(const FormatValue& value, const Layout& layout) {
  if (value.numbers.empty())
    return padded(value.text.substr(0, static_cast<size_t>(layout.precision)), layout, false);  // -1: all of it
  std::string out;
  for (const double x : value.numbers) out += (out.empty() ? "" : " ") + laidOut(x, value.whole, layout);
  return out;
}

}  // namespace text_detail

template <class... Parts>
std::string concat(const Parts&... parts) {
  return (std::string() + ... + parts);
}

/// %f stands for a float, %d for a number without its fraction, %c for a colour, %p for a point, vector or normal, %m
/// for a matrix, %s for a string; %e and %g are those of C. A value is written by its own type, even if the letter
/// differs. As in C, width and precision may stand before the letter ("%04d", "%.2f", "%-8s"); they hold for each
/// number of a value. %% is a percent sign. A letter that stands for no value, or for
/// which none is left, stays as it is.
inline std::string formatValues(const std::string& pattern, const std::vector<FormatValue>& values) {
  std::string out;
  size_t next = 0;
  for (size_t i = 0; i < pattern.size();) {
    if (pattern.compare(i, 2, "%%") == 0) {
      out += '%';
      i += 2;
      continue;
    }
    const text_detail::Layout layout = pattern[i] == '%' ? text_detail::layoutAt(pattern, i) : text_detail::Layout();
    if (layout.letter != 0 && next < values.size()) {
      out += text_detail::laidOut(values[next++], layout);
      i = layout.end;
    } else {
      out += pattern[i++];
    }
  }
  return out;
}
template <class... Values>
std::string format(const std::string& pattern, const Values&... values) {
  return formatValues(pattern, {text_detail::valueOf(values)...});
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

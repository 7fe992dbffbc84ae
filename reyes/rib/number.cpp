#include "reyes/rib/number.h"

#include <bit>
#include <cfloat>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace tomales::rib {
namespace {

constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                   1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// The written number is mantissa * 10^exponent.
struct Decimal {
  uint64_t mantissa = 0;
  int exponent = 0, digits = 0;
};

bool isDigit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

const char* takeDigits(const char* p, const char* last, Decimal& d) {
  for (; p < last && isDigit(*p); ++p, ++d.digits) d.mantissa = d.mantissa * 10 + static_cast<uint64_t>(*p - '0');
  return p;
}

// Returns null if it is not an exponent of at most three digits.
const char* takeExponent(const char* p, const char* last, Decimal& d) {
  const bool negative = p < last && *p == '-';
  if (p < last && (*p == '-' || *p == '+')) ++p;
  const char* start = p;
  int e = 0;
  for (; p < last && isDigit(*p) && p - start < 4; ++p) e = e * 10 + (*p - '0');
  d.exponent += negative ? -e : e;
  return p > start && p - start < 4 ? p : nullptr;
}

// Rounding decimal -> double -> float equals decimal -> float, unless the double lies half-way between two
// floats (its 29 surplus bits are 100...0), where the first rounding may have hidden the true side.
bool roundOnce(double wide, float& narrow) {
  const double size = std::abs(wide);
  const bool halfWay = (std::bit_cast<uint64_t>(wide) & 0x1fffffffU) == 0x10000000U;
  if ((size < FLT_MIN && size != 0) || size > FLT_MAX || halfWay) return false;
  narrow = static_cast<float>(wide);
  return true;
}

template <class T>
const char* scanSlowly(const char* first, const char* last, T& out, T (*fromText)(const char*, char**)) {
  const auto [end, error] = std::from_chars(first, last, out);
  if (error == std::errc::result_out_of_range) out = fromText(std::string(first, end).c_str(), nullptr);
  return end;
}

}  // namespace

// Clinger's fast path: both mantissa and power of ten are exact doubles, so one operation rounds once.
const char* scanEverydayNumber(const char* first, const char* last, ScannedNumber& out) {
  const char* p = first;
  const bool negative = p < last && *p == '-';
  if (p < last && (*p == '-' || *p == '+')) ++p;
  Decimal d;
  p = takeDigits(p, last, d);
  if (p < last && *p == '.') {
    const int whole = d.digits;
    p = takeDigits(p + 1, last, d);
    d.exponent = whole - d.digits;
  }
  if (d.digits == 0 || d.digits > 19) return nullptr;
  if (p < last && (*p == 'e' || *p == 'E') && !(p = takeExponent(p + 1, last, d))) return nullptr;
  if (d.mantissa >> 53 != 0 || d.exponent < -22 || d.exponent > 22) return nullptr;
  const auto mantissa = static_cast<double>(d.mantissa);
  const double size = d.exponent < 0 ? mantissa / kPowersOfTen[-d.exponent] : mantissa * kPowersOfTen[d.exponent];
  out.wide = negative ? -size : size;
  return roundOnce(out.wide, out.narrow) ? p : nullptr;
}

const char* scanNumber(const char* first, const char* last, ScannedNumber& out) {
  if (const char* end = scanEverydayNumber(first, last, out)) return end;
  const bool plus = first < last && *first == '+';
  if (plus && first + 1 < last && first[1] == '-') return first;
  const char* digits = first + (plus ? 1 : 0);
  const char* end = scanSlowly(digits, last, out.wide, std::strtod);
  if (end == digits) return first;
  scanSlowly(digits, last, out.narrow, std::strtof);
  return end;
}

}  // namespace tomales::rib

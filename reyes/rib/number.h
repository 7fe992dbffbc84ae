// Converts text to numbers, to the last bit as strtof and strtod do (rounded to nearest), but several times faster for
// the short decimals that RIB is made of.
#pragma once

namespace tomales::rib {

/// A number in both precisions: rounding to float by way of double would round twice.
struct ScannedNumber {
  double wide;
  float narrow;
};

/// Reads a number off [first, last), "inf" and "nan" included; one beyond the largest becomes infinity. Returns the end
/// of the number, or `first` if there is none.
const char* scanNumber(const char* first, const char* last, ScannedNumber& out);

/// Does the quick part of scanNumber(). It returns null if there is no number, or one that is not of the everyday kind.
const char* scanEverydayNumber(const char* first, const char* last, ScannedNumber& out);

}  // namespace tomales::rib

// Text -> numbers, to the last bit as strtof and strtod (rounded to nearest), but several times faster for
// the short decimals that RIB is made of.
#pragma once

namespace tomales::rib {

/// A number in both precisions: rounding to float by way of double would round twice.
struct ScannedNumber {
  double wide;
  float narrow;
};

/// Reads a number off [first, last), "inf" and "nan" included, beyond the largest as infinity. Returns where
/// it ends; `first`, if there is no number.
const char* scanNumber(const char* first, const char* last, ScannedNumber& out);

/// The quick part of scanNumber: null, if the number is not of the everyday kind or there is none.
const char* scanEverydayNumber(const char* first, const char* last, ScannedNumber& out);

}  // namespace tomales::rib

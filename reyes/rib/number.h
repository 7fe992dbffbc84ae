// Converts text to numbers, to the last bit as strtof and strtod do (rounded to nearest), but several times faster for
// the short decimals that RIB is made of.
#pragma once

namespace tomales::rib {

/// A number in both precisions, because a conversion from double to float would round twice.
struct ScannedNumber {
  double wide;
  float narrow;
};

/// Reads a number at the start of [first, last), "inf" and "nan" included. A number beyond the largest float or double
/// becomes infinity. Returns the end of the number, or `first` if there is none.
const char* scanNumber(const char* first, const char* last, ScannedNumber& out);

/// The fast path of scanNumber(). Returns null if there is no number, or one that needs the slow path.
const char* scanEverydayNumber(const char* first, const char* last, ScannedNumber& out);

}  // namespace tomales::rib

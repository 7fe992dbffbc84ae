// What a sample of errors says about the error of the whole picture, and how certain that is.
#pragma once
#include <span>

namespace tomales {

/// One place of the picture. Both are shares of the colour that is right there, means over its channels.
struct AuditedError {
  float error = 0;  ///< How far the picture is from the mean of two independent estimates of what is right.
  float noise = 0;  ///< Half of the difference of those two, which is as large as the noise of their mean.
};

struct ErrorEstimate {
  double mean = 0;           ///< Mean absolute relative error of the picture, without the noise of the audit.
  double low = 0, high = 0;  ///< It lies between these with 90 % confidence; below `noise` nothing is told apart.
  double noise = 0;          ///< Mean of AuditedError::noise.
  double p99 = 0;  ///< 99 % of the places err by less. A few places decide this, so nothing says how certain it is.

  /// False if the audit is noisier than the picture errs, so that it has only found a bound of the error.
  bool tells() const { return mean >= noise; }
};

/// The noise is taken off in squares: it and the error are independent. The interval is that of the percentile
/// bootstrap (Efron and Tibshirani 1993) over the places, with random numbers that depend on nothing.
ErrorEstimate estimateError(std::span<const AuditedError> places);

}  // namespace tomales

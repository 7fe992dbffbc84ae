// Estimates the error of the whole picture, with a confidence interval, from a sample of errors.
#pragma once
#include <cstddef>
#include <span>

namespace tomales {

/// One place of the picture. Both figures are relative to the right colour there, and means over its channels.
struct AuditedError {
  float error = 0;  ///< Distance of the picture from the mean of two independent estimates of the truth.
  float noise = 0;  ///< Half of the difference of those two estimates, which is as large as the noise of their mean.
};

struct ErrorEstimate {
  double mean = 0;  ///< Mean absolute relative error of the picture, without the noise of the audit.
  double low = 0,
         high = 0;   ///< `mean` lies between these with 90 % confidence; errors below `noise` cannot be told from 0.
  double noise = 0;  ///< Mean of AuditedError::noise.
  double p99 = 0;    ///< 99 % of the places err by less. A few places decide this, so it has no interval.

  /// Returns false if the noise of the audit exceeds the error of the picture: then it has found only a bound.
  bool tells() const { return mean >= noise; }
};

/// The noise is subtracted in squares, as if it were the same share of the error at all places. The interval is that of
/// the percentile bootstrap (Efron and Tibshirani 1993) over the places, with random numbers that depend on nothing.
/// Its upper end is that of errors from which no noise is subtracted: noise that lies elsewhere adds less to them.
ErrorEstimate estimateError(std::span<const AuditedError> places);

/// Two independent estimates of the error of a block that should be smooth, relative to the right light there: positive
/// if the block is too bright.
struct SmoothBlock {
  double off[2];
};

/// The smudges that `tomales compare` reports, estimated from some of the blocks.
struct SmudgeEstimate {
  static constexpr size_t kFewestBlocks = 8;

  int size = 0;              ///< Pixels along an edge of a block.
  size_t blocks = 0;         ///< Number of smooth blocks.
  double deviation = 0;      ///< Standard deviation of picture / truth over the blocks, over its mean.
  double low = 0, high = 0;  ///< `deviation` lies between these with 90 % confidence.
  double noise = 0;          ///< Deviation that the audit's own noise would show.

  bool isKnown() const { return blocks >= kFewestBlocks; }
  bool tells() const { return deviation >= noise; }
};

/// The variance is the covariance of both estimates: their noise is independent, so it adds nothing. The interval is
/// found as by estimateError().
SmudgeEstimate estimateSmudges(int size, std::span<const SmoothBlock> blocks);

}  // namespace tomales

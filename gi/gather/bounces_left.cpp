#include "gi/gather/bounces_left.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reyes/base/deep_stack.h"

namespace tomales {

BouncesLeft bouncesLeft(int bounces, double reflected, double last, double ratio) {
  constexpr double kLargestRatio = 0.999;
  const double r = std::min(ratio, kLargestRatio), rest = last * r / (1 - r);
  return {bounces, r > 0 ? rest / (reflected + rest) : 0, r};
}

void tellBouncesLeft(const BouncesLeft& left, bool isAsked, const char* code, const SourceLoc& where, Log& log) {
  constexpr double kLittle = 0.01;
  const Severity severity = left.share < kLittle ? Severity::Info : isAsked ? Severity::Note : Severity::Warning;
  std::string message =
      fmt::format("after {} bounces {:.1f} % of the light that surfaces send each other is left, and is missing",
                  left.bounces, 100 * left.share);
  const int more =
      left.share < kLittle ? 0 : static_cast<int>(std::ceil(std::log(kLittle / left.share) / std::log(left.ratio)));
  if (more > 0) message += fmt::format(": each bounce has {:.0f} % of the one before", 100 * left.ratio);
  if (more > 0 && left.bounces + more <= kMostBounces)
    message +=
        fmt::format(", and --bounces {} or \"bounces\" of the indirect light would leave 1 %", left.bounces + more);
  log.report(severity, code, where, message);
}

}  // namespace tomales

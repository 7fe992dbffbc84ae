// The functions that say how far an irradiance record may be used, as indirect lights ("errorfunction") and the command
// line (--error-function) name them. gi/irradiance_cache.h has the values that a function works with.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace tomales {

enum class ErrorFunction {
  Screen,   ///< approximate-gi eq. 2 to 5
  Ward,     ///< Ward's split sphere, with the limits of Screen.
  Hessian,  ///< Schwarzhaupt, Jensen, Jarosz 2012
  Split,    ///< Ward and Heckbert 1992, for comparison: no limits in pixels, and records do not check each other.
  /// Screen as published, for comparison: records do not check each other, and each is extrapolated by its own
  /// gradients alone.
  Plain,
};

struct ErrorFunctionInfo {
  ErrorFunction function;
  const char* name;
  bool splitSphere = false;  ///< As Ward's: a record's size is the harmonic mean of its rays' lengths.
  bool published = false;    ///< The function works as published, without what this renderer adds.
  bool curvature = false;    ///< Records need second derivatives.
  /// The CacheSettings of records for `maxerror` 1. Ward's split sphere needs a = 1/4 for the error that the paper's
  /// function has at kappa = 1 (docs/measured/irradiance_cache.md), so that `maxerror` means the same for both. The
  /// Hessian, which knows where light is even, has about as many records as that.
  float kappa = 1, maxPixels = 10, minPixels = 1.5f, enough = 0.05f;
  /// Where more error is allowed, records lie less close to edges, so that some are left for other places and fewer
  /// overlap: their error is then no noise (docs/decisions/0106).
  bool limitsFollowError = false;
};

inline constexpr float kNoLimit = std::numeric_limits<float>::infinity();
inline constexpr ErrorFunctionInfo kErrorFunctions[] = {
    {ErrorFunction::Screen, "screen"},
    {.function = ErrorFunction::Ward, .name = "ward", .splitSphere = true, .kappa = 4},
    {.function = ErrorFunction::Hessian,
     .name = "hessian",
     .curvature = true,
     .kappa = 0.87f,
     .maxPixels = 40,
     .minPixels = 1,
     .enough = 0.2f,
     .limitsFollowError = true},
    {.function = ErrorFunction::Split,
     .name = "split",
     .splitSphere = true,
     .published = true,
     .kappa = 4,
     .maxPixels = kNoLimit,
     .minPixels = 0},
    {.function = ErrorFunction::Plain, .name = "plain", .published = true},
};

constexpr const ErrorFunctionInfo& infoOf(ErrorFunction function) {
  return kErrorFunctions[static_cast<size_t>(function)];
}

constexpr std::optional<ErrorFunction> errorFunctionNamed(std::string_view name) {
  for (const ErrorFunctionInfo& info : kErrorFunctions)
    if (name == info.name) return info.function;
  return std::nullopt;
}

/// The names for help texts: "screen|ward".
inline std::string errorFunctionNames() {
  std::string out;
  for (const ErrorFunctionInfo& info : kErrorFunctions) out += (out.empty() ? "" : "|") + std::string(info.name);
  return out;
}

}  // namespace tomales

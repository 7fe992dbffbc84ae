// The functions that say how far an irradiance record may be used, as indirect lights ("errorfunction") and the command
// line (--error-function) name them. gi/irradiance_cache.h has the values that a function works with.
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace tomales {

enum class ErrorFunction {
  Screen,   ///< The equations of Screen.
  Ward,     ///< Ward's split sphere, with the limits of Screen.
  Hessian,  ///< The equations of Hessian.
  Split,    ///< Ward's split sphere, for comparison: no limits in pixels, and fewer amendments.
  Plain,    ///< Screen with fewer amendments, for comparison.
};

/// The published equations that a function has; gi/cache/published.h has a type for each.
enum class PublishedEquations { Screen, SplitSphere, Hessian };

/// The amendments that this renderer adds to the published equations; gi/cache/amendments/switches.h says where each
/// is.
enum class Amendment { SecondOrder, Disagreements, Reach, Behind, Occluders, Slopes };

constexpr uint32_t bitOf(Amendment amendment) { return uint32_t{1} << static_cast<uint32_t>(amendment); }

/// With this kappa, Ward's split sphere makes as large an error as the function of Tabellion and Lamorlette 2004 does
/// with kappa 1 (docs/measured/irradiance_cache.md).
inline constexpr float kSplitSphereKappa = 4;
inline constexpr float kNoLimit = std::numeric_limits<float>::infinity();
/// The amendments that are left out for comparison with what was published: records do not check each other, each is
/// extrapolated by its own gradients alone, and none serves farther in shading than where records are placed.
inline constexpr uint32_t kAsPublished =
    bitOf(Amendment::SecondOrder) | bitOf(Amendment::Disagreements) | bitOf(Amendment::Reach);

struct ErrorFunctionInfo {
  ErrorFunction function;
  const char* name;
  PublishedEquations equations = PublishedEquations::Screen;
  uint32_t without = 0;  ///< Bits of the amendments that records of this function do without.
  /// The values of CacheSettings for `maxerror` 1. They are chosen so that one `maxerror` means the same for all
  /// functions. The Hessian, which knows where light is even, makes about as many records as the others.
  float kappa = 1, maxPixels = 10, minPixels = 1.5f, minWeight = 0.05f;
  /// True if minPixels grows with `maxerror`, and `minWeight` falls with it. Then fewer records lie close to edges, and
  /// fewer overlap: their error is no noise, which overlapping would average (docs/decisions/0106).
  bool limitsFollowError = false;

  bool needsCurvature() const { return equations == PublishedEquations::Hessian; }
};

inline constexpr ErrorFunctionInfo kErrorFunctions[] = {
    {ErrorFunction::Screen, "screen"},
    {.function = ErrorFunction::Ward,
     .name = "ward",
     .equations = PublishedEquations::SplitSphere,
     .kappa = kSplitSphereKappa},
    {.function = ErrorFunction::Hessian,
     .name = "hessian",
     .equations = PublishedEquations::Hessian,
     .without = bitOf(Amendment::Reach),  // its records overlap enough without it
     .kappa = 0.87f,
     .maxPixels = 40,
     .minPixels = 1,
     .minWeight = 0.2f,
     .limitsFollowError = true},
    {.function = ErrorFunction::Split,
     .name = "split",
     .equations = PublishedEquations::SplitSphere,
     .without = kAsPublished,
     .kappa = kSplitSphereKappa,
     .maxPixels = kNoLimit,
     .minPixels = 0},
    {.function = ErrorFunction::Plain, .name = "plain", .without = kAsPublished},
};

constexpr const ErrorFunctionInfo& infoOf(ErrorFunction function) {
  return kErrorFunctions[static_cast<size_t>(function)];
}

constexpr std::optional<ErrorFunction> errorFunctionNamed(std::string_view name) {
  for (const ErrorFunctionInfo& info : kErrorFunctions)
    if (name == info.name) return info.function;
  return std::nullopt;
}

/// Returns the names for help texts: "screen|ward".
inline std::string errorFunctionNames() {
  std::string out;
  for (const ErrorFunctionInfo& info : kErrorFunctions) out += (out.empty() ? "" : "|") + std::string(info.name);
  return out;
}

}  // namespace tomales

// Noun: the answers of rays when the points of a batch were shaded, so that shading them again traces none. An answer
// is found by its question (the point, the direction to the light), so a light that has moved finds none and is traced
// anew. Threads: one batch is shaded by one thread.
#pragma once
#include <array>
#include <compare>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

/// One sample of one light, as seen by one run of the shader over part of a batch.
struct ShadowQuestion {
  int subBatch, light, sample;
  auto operator<=>(const ShadowQuestion&) const = default;
};

struct ShadowAnswer {
  enum Passed : uint8_t { Unknown, Everything, Nothing, Part };
  uint64_t asked = 0;           ///< Checksum of the directions to the light.
  std::vector<uint8_t> passed;  ///< A value of Passed for every point.
  std::vector<vec3> parts;      ///< The fractions of the points that have Part, in order.
};

/// E/pi and the dominant directions for red, green and blue.
struct IndirectAnswer {
  vec3 E;
  std::array<vec3, 3> dominant;
  std::vector<vec3> shares;  ///< The part of E that each group of lights brings; empty: not known.
};

/// Returns the answer as it would be if each share were brighter by its gain. Pre: there are as many gains as shares.
inline IndirectAnswer withGains(IndirectAnswer answer, std::span<const vec3> gains) {
  answer.E = vec3(0.0f);
  for (size_t g = 0; g < gains.size(); ++g) {
    answer.shares[g] *= gains[g];
    answer.E += answer.shares[g];
  }
  return answer;
}

struct RayAnswers {
  bool recording = false;
  /// True if no record of the irradiance cache comes or goes while these answers are kept, so that its answers are kept
  /// too.
  bool recordsStay = false;
  std::map<ShadowQuestion, ShadowAnswer> shadows;
  std::map<uint64_t, IndirectAnswer> indirect;  ///< Answers at points that the irradiance cache does not serve.
  /// Answers of the irradiance cache elsewhere; empty: it serves nothing.
  std::map<uint64_t, std::optional<IndirectAnswer>> interpolated;
};

}  // namespace tomales

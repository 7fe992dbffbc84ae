// The audit of a picture: light is found again in some of its pixels, by many rays and without records and maps, and
// compared with what the picture has there. Noise of the picture's own rays cannot tell how wrong it is, because
// interpolation errs alike with every seed (docs/decisions/0145).
#pragma once
#include <atomic>
#include <optional>

#include "reyes/app/frame/audit_estimate.h"
#include "reyes/base/stats.h"
#include "reyes/deep.h"
#include "reyes/shade.h"

namespace tomales {

struct AuditPlan {
  size_t pixels = 300;
  uint32_t seed = 0;     ///< Decides which, and the rays there.
  bool indirect = true;  ///< The frame has indirect light.
};

struct AuditReport {
  size_t pixels = 0;      ///< Those that the errors are of: they see something that is lit.
  int paths = 0;          ///< At each point that they see, for indirect light; 0 if that was not audited.
  int lightSamples = 0;   ///< At each of them, of each light; 0 if direct light was not audited.
  ErrorEstimate picture;  ///< Of all light together. All errors are shares of the picture's colour,
  std::optional<ErrorEstimate> indirect, direct;  ///< those of one kind of light too.
};

/// `context` is that in which the picture is shaded. Pre: gathering is done, so that shading gives the picture's
/// colours. The same bits for any number of threads. Nothing of the picture changes.
AuditReport auditFrame(const DeepFrame& layout, const TileReader& tiles, const Scene& scene,
                       const ShadingSystem& shading, const ShadeContext& context, const AuditPlan& plan,
                       const std::atomic<bool>& cancelled);

/// Writes the report to the statistics.
void recordAudit(const AuditReport& report, Stats& stats);
/// One sentence.
std::string sentenceOf(const AuditReport& report);

}  // namespace tomales

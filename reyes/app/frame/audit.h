// The audit of a picture: in some of its pixels, light is computed again with many rays and without records and maps,
// and compared with the picture. The noise of the picture's own rays cannot show how wrong it is, because interpolation
// makes the same error with every seed (docs/decisions/0145).
#pragma once
#include <optional>

#include "reyes/app/frame/audit_estimate.h"
#include "reyes/app/frame/audit_pixels.h"
#include "reyes/app/frame/audit_smudges.h"
#include "reyes/base/stats.h"
#include "reyes/base/stop.h"
#include "reyes/deep.h"
#include "reyes/image_compare.h"
#include "reyes/shade.h"

namespace tomales {

struct AuditSettings {
  size_t pixels = 300;
  uint32_t seed = 0;     ///< Decides which pixels are audited, and the rays there.
  bool direct = true;    ///< Direct light is audited, if the picture has any.
  bool indirect = true;  ///< Indirect light is audited: the frame has some.
  bool lobes = false;    ///< So are its highlights.
  /// The noise of the audit may be a share of the error that it finds, or of this one if it is larger, because nobody
  /// asks how much smaller an error is.
  double leastError = 0;
  double leastSmudges = 0;  ///< The same for SmudgeEstimate::deviation.
  int lightSamples = 0;     ///< The most samples of each light in an audited picture; 0: as many as the lights ask.
  size_t smudgeSizes = kSmudgeSizes.size();  ///< SmudgeSettings::sizes.
};

struct AuditReport {
  size_t pixels = 0;  ///< Number of pixels that the errors are computed from; these see something that is lit.
  int paths =
      0;  ///< Paths for indirect light at each point that these pixels see; 0 if indirect light was not audited.
  int lightSamples = 0;   ///< Samples of each light at each of these points; 0 if direct light was not audited.
  ErrorEstimate picture;  ///< Error of all light together. All errors are shares of the picture's colour.
  /// Errors of indirect and of direct light. They too are shares of the picture's colour.
  std::optional<ErrorEstimate> indirect, direct;
  /// Error of the highlights of indirect light, whose model more rays do not mend (docs/decisions/0187). It is not part
  /// of `indirect`. None if no highlights were audited or seen.
  std::optional<ErrorEstimate> highlights;
  /// Estimates the mean error that too few pixel samples add to those errors. It takes samples as independent. They are
  /// stratified, and filters are wider than a pixel, so the true error is mostly smaller. Details that no sample sees
  /// can make it larger.
  double pixelSamples = 0;
  std::vector<SmudgeEstimate> smudges;  ///< One for each size of blocks of which there are enough smooth ones.

  /// Returns the smallest size, whose blocks show what those of larger sizes do; null if no region is smooth.
  const SmudgeEstimate* finestSmudges() const { return smudges.empty() ? nullptr : &smudges.front(); }
};

/// The light of one kind at each pixel: in the picture, and by two independent sets of many rays.
struct FoundLight {
  std::vector<vec3> picture, sets[2];
  int rays = 0;  ///< Number of rays in each set.

  /// Returns the light that is missing in the picture.
  vec3 missing(size_t p) const { return 0.5f * (sets[0][p] + sets[1][p]) - picture[p]; }
  vec3 noise(size_t p) const { return 0.5f * (sets[0][p] - sets[1][p]); }
};

/// Some pixels of a frame, and their true light. Several pictures can be compared with that light; its rays are traced
/// for the first of them. The bits are the same for any number of threads; nothing of the frame changes. The references
/// outlive it. Threads: one at a time.
class Audit {
 public:
  Audit(const DeepFrame& layout, const TileReader& tiles, const Scene& scene, const ShadingSystem& shading,
        const AuditSettings& settings, StopToken stop);

  /// Returns the errors of the picture that is shaded in this context. Pre: gathering is done, so that shading gives
  /// the picture's colours.
  AuditReport of(const ShadeContext& context);

  /// Returns the colours of the pixels in that picture.
  std::vector<SampledColor> shade(ShadeContext context) const;
  double pointCount() const;  ///< Points that these pixels see.

 private:
  int findDirect(ShadeContext context);
  int findIndirect(ShadeContext context);
  int missingPaths() const;
  void findGlossy(ShadeContext context);
  std::vector<vec3> colors(const ShadeContext& context) const;
  std::vector<vec3> highlightsBeside(const std::vector<vec3>& without, ShadeContext context) const;
  double pixelSampleError() const;
  void addSets(FoundLight& light, ShadeContext context, int rays);
  std::vector<AuditedError> errorsOf(std::initializer_list<const FoundLight*> kinds) const;

  const Scene& scene_;
  const ShadingSystem& shading_;
  const AuditSettings settings_;
  const std::vector<AuditPixel> pixels_;
  const int samplesPerPixel_;
  StopToken stop_;
  std::vector<SampledColor> picture_;
  SmudgeAudit smudges_;
  FoundLight direct_, indirect_;
  FoundLight highlights_;                 ///< What paths along lobes change in the sets of indirect_.
  std::vector<size_t> glossy_;            ///< Indices of the pixels that see highlights of indirect light.
  std::vector<AuditPixel> glossyPixels_;  ///< Those pixels.
};

/// Writes the report to the statistics.
void recordAudit(const AuditReport& report, Stats& stats);
/// Returns the report in one sentence.
std::string sentenceOf(const AuditReport& report);

}  // namespace tomales

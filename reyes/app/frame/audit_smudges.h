// The part of an audit that looks for smudges: light that is wrong over whole blocks of a smooth region. A mean over
// all pixels hardly shows them, but the eye sees them.
#pragma once

#include "reyes/app/frame/audit_estimate.h"
#include "reyes/base/stop.h"
#include "reyes/deep.h"
#include "reyes/image.h"
#include "reyes/image_compare.h"
#include "reyes/shade.h"

namespace tomales {

struct SmudgeSettings {
  size_t blocks = 0;          ///< Number of blocks of each size.
  size_t sizes = 4;           ///< Number of sizes, the first ones of kSmudgeSizes.
  uint32_t seed = 0;          ///< Decides which blocks, and the rays there.
  int lightSamples = 0;       ///< Samples of each light in each set of rays that finds the truth.
  double leastDeviation = 0;  ///< AuditSettings::leastSmudges.
};

/// Some blocks of pixels of each size, and their true light, whose rays are traced for the first picture. The bits are
/// the same for any number of threads. The references outlive it. Threads: one at a time.
class SmudgeAudit {
 public:
  SmudgeAudit(const DeepFrame& layout, const TileReader& tiles, const Scene& scene, const ShadingSystem& shading,
              const SmudgeSettings& settings, StopToken stop);

  ~SmudgeAudit();

  /// Returns the smudges of the picture that is shaded in this context, for each size that has enough blocks. All
  /// pixels of a block see something. Pre: as for Audit::of().
  std::vector<SmudgeEstimate> of(const ShadeContext& context);

 private:
  struct Part;
  struct Blocks;
  size_t cellAt(int x, int y) const;
  void add(int size);
  void copyPixelsOf(Blocks& blocks);
  std::vector<float> shade(const Blocks& blocks, const ShadeContext& context, int half) const;
  void addSets(Blocks& blocks, ShadeContext context, int rays) const;
  SmudgeEstimate estimate(const Blocks& blocks, const std::vector<float>& picture) const;

  const DeepFrame& layout_;
  const TileReader& tiles_;
  const Scene& scene_;
  const ShadingSystem& shading_;
  const SmudgeSettings settings_;
  StopToken stop_;
  const int across_;              ///< Cells of 8 x 8 pixels in a row.
  std::vector<uint8_t> covered_;  ///< Number of pixels in each cell that see something.
  std::vector<Blocks> sizes_;
};

}  // namespace tomales

// Decides what is shaded next in a relighting: what pages ask for, and the order of the steps (docs/decisions/0172).
// Threads: plain object.
#pragma once
#include "reyes/app/relight/edited_layers.h"
#include "reyes/app/relight/picture_parts.h"

namespace tomales {

/// One step of the work.
struct WorkStep {
  enum Kind { Part, Coarse, Gather, Check, Rehearse } kind;
  size_t layer = 0, part = 0;
  uint32_t number = 0;  ///< LayerParts::wanted() when it begins.
  EditState edit{};
  std::string variable{};
  PixelRect pixels{};  ///< Those whose light is gathered.
};

struct WorkOrder {
  ivec2 pointedAt;                  ///< The raster pixel near which parts come first.
  std::optional<PixelRect> only{};  ///< Nothing outside of these pixels is shaded.
  std::optional<PixelRect> toGather{};
  bool wantsWhole = true;
  bool isChecked = false;    ///< The layers have been checked to add up.
  bool isRehearsed = false;  ///< The first picture is there, and the rays of the coarse one are known.

  /// Returns nothing if all is done.
  std::optional<WorkStep> next(const EditedLayers& layers, const PictureParts& parts) const;
  /// Tells whether a running step is still of use.
  bool isWanted(const WorkStep& step, const EditedLayers& layers) const;
  /// Notes that a step is done.
  void finish(const WorkStep& step, EditedLayers& layers);

 private:
  std::optional<WorkStep> nextPart(size_t fromLayer, size_t toLayer, const EditedLayers& layers,
                                   const PictureParts& parts) const;
};

}  // namespace tomales

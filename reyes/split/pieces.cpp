#include <fmt/format.h>

#include "reyes/scattered.h"
#include "reyes/split/splitter.h"

namespace tomales {
namespace {

void report(const Splitter::GivenUp& givenUp, const Object& o, Stats& stats, Log& log) {
  stats.geometry.eyeSplitsGivenUp += givenUp.atEye;
  if (givenUp.atEye > 0)
    log.report(
        Severity::Warning, "split-eye-plane", o.where,
        fmt::format("{} passes through the plane of the eye: parts that come too near to it while the shutter is "
                    "open are not drawn; set the near distance of Clipping if it shows",
                    objectName(o)));
  if (givenUp.tooMany > 0)
    log.report(
        Severity::Missing, "split-too-many", o.where,
        fmt::format("{} cannot be cut into pieces of the size of a grid: its coordinates, its displacement bound, "
                    "its blur or the magnification are too large; parts are not drawn",
                    objectName(o)));
}

/// Makes pieces of an object by split(splitter, pieces), and reports; it is the same for patches and pieces.
template <class Split>
std::vector<SubPatch> piecesBy(const SplitContext& context, int object, Splitting splitting, size_t expected,
                               const Split& split) {
  Splitter splitter(context, object, splitting);
  std::vector<SubPatch> pieces;
  pieces.reserve(expected);
  split(splitter, pieces);
  report(splitter.givenUp(), context.scene.objects[static_cast<size_t>(object)], context.stats, context.log);
  context.stats.geometry.subpatches +=
      std::count_if(pieces.begin(), pieces.end(), [](const SubPatch& p) { return !p.coarse; });
  return pieces;
}

}  // namespace

std::vector<SubPatch> splitPatches(const SplitContext& context, int object, std::span<const uint32_t> patches,
                                   Splitting splitting) {
  const auto split = [&](Splitter& splitter, std::vector<SubPatch>& out) {
    const Object& o = context.scene.objects[static_cast<size_t>(object)];
    prefetch(o.shape(), patches, [](uint32_t patch) { return patch; });
    std::vector<uint32_t> others;
    std::vector<Bound3> bounds;
    const bool dots = !patches.empty() && splitter.hasDots(patches[0]);
    for (size_t i = 0; dots && i < patches.size(); ++i)
      if (const auto bare = splitter.takeDot(patches[i], out)) {
        others.push_back(patches[i]);
        bounds.push_back(*bare);
      }
    const std::span<const uint32_t> left = dots ? std::span<const uint32_t>(others) : patches;
    const std::vector<PatchSize> sizes = measureWhole(o, context.camera, left);
    for (size_t i = 0; i < left.size(); ++i) splitter.splitPatch(left[i], {sizes[i], dots ? &bounds[i] : nullptr}, out);
  };
  return piecesBy(context, object, splitting, patches.size(), split);
}

std::vector<SubPatch> splitPiece(const SplitContext& context, const SubPatch& coarse) {
  return piecesBy(context, coarse.object, Splitting::Lazily, 1,
                  [&](Splitter& splitter, std::vector<SubPatch>& out) { splitter.splitPiece(coarse, out); });
}

}  // namespace tomales

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

/// Makes pieces by split(splitter, pieces), and reports; it is the same for patches and pieces.
template <class Split>
std::vector<SubPatch> piecesBy(Splitter splitter, const Object& object, size_t expected, Stats& stats, Log& log,
                               const Split& split) {
  std::vector<SubPatch> pieces;
  pieces.reserve(expected);
  split(splitter, pieces);
  report(splitter.givenUp(), object, stats, log);
  stats.geometry.subpatches += std::count_if(pieces.begin(), pieces.end(), [](const SubPatch& p) { return !p.coarse; });
  return pieces;
}

}  // namespace

std::vector<SubPatch> splitPatches(const Scene& scene, int object, std::span<const uint32_t> patches,
                                   const Camera& camera, const PixelRect& window, Stats& stats, Log& log,
                                   Splitting splitting, StopToken stop) {
  return piecesBy(Splitter(scene, object, camera, window, stats, splitting, stop),
                  scene.objects[static_cast<size_t>(object)], patches.size(), stats, log,
                  [&](Splitter& splitter, std::vector<SubPatch>& out) {
                    const Object& o = scene.objects[static_cast<size_t>(object)];
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
                    const std::vector<PatchSize> sizes = measureWhole(o, camera, left);
                    for (size_t i = 0; i < left.size(); ++i)
                      splitter.splitPatch(left[i], {sizes[i], dots ? &bounds[i] : nullptr}, out);
                  });
}

std::vector<SubPatch> splitPiece(const Scene& scene, const SubPatch& coarse, const Camera& camera,
                                 const PixelRect& window, Stats& stats, Log& log, StopToken stop) {
  return piecesBy(Splitter(scene, coarse.object, camera, window, stats, Splitting::Lazily, stop),
                  scene.objects[static_cast<size_t>(coarse.object)], 1, stats, log,
                  [&](Splitter& splitter, std::vector<SubPatch>& out) { splitter.splitPiece(coarse, out); });
}

}  // namespace tomales

// Private to gi: decides which surfaces have radiosity maps (Tabellion and Lamorlette 2004, section 4.4, Christensen
// and Batali 2004, section 6.3), and how fine these are.
#pragma once
#include <span>

#include "gi/radiosity/maps.h"

namespace tomales {

constexpr size_t kChartsPerTask = 16;  ///< Charts that one thread works on at a time.

/// The charts of one side by patch; empty if the object has none there.
struct SurfaceCharts {
  std::vector<RadiosityChart> front, back;
  std::vector<RadiosityChart>& side(bool isBack) { return isBack ? back : front; }
  const std::vector<RadiosityChart>& side(bool isBack) const { return isBack ? back : front; }
};

/// Returns the objects whose radiosity is baked. Reports in the log which are not, and why.
std::vector<int> bakedObjects(const Scene& scene, const ShadingSystem& shading, Log& log);
/// Returns their charts by object, without texels. Reports in the log if all together exceed the limit.
std::vector<SurfaceCharts> layOutCharts(const Scene& scene, const std::vector<int>& objects, const Camera& camera,
                                        const RadiositySettings& settings, Log& log);

/// Texels of one side of an object that are baked together, in successive charts.
struct TexelRun {
  int object;
  bool back;
  size_t patch, texel, count;
};
/// Returns all runs, in the order of objects, sides, patches and texels.
std::vector<TexelRun> texelRuns(std::span<const SurfaceCharts> surfaces);

/// Calls visit(patch, texel) for each texel of a run.
template <class Visit>
void forEachTexel(std::span<const RadiosityChart> charts, const TexelRun& run, const Visit& visit) {
  size_t patch = run.patch, t = run.texel;
  for (size_t k = 0; k < run.count; ++k, ++t) {
    if (t == charts[patch].texelCount()) {
      ++patch;
      t = 0;
    }
    visit(static_cast<uint32_t>(patch), t);
  }
}

}  // namespace tomales

// Private to gi: which surfaces hold radiosity (approximate-gi 4.4, irradiance-atlas 6.3), and how finely.
#pragma once
#include <span>

#include "gi/radiosity_maps.h"

namespace tomales {

constexpr size_t kChartsPerTask = 16;  ///< That one thread works on at a time.

/// By patch; empty: none.
struct SurfaceCharts {
  std::vector<RadiosityChart> front, back;
  std::vector<RadiosityChart>& side(bool isBack) { return isBack ? back : front; }
  const std::vector<RadiosityChart>& side(bool isBack) const { return isBack ? back : front; }
};

/// Objects whose radiosity is baked. Says in the log which are not, and why.
std::vector<int> bakedObjects(const Scene& scene, const ShadingSystem& shading, Log& log);
/// Their charts without texels, by object. Says in the log where all together are too fine.
std::vector<SurfaceCharts> layOutCharts(const Scene& scene, const std::vector<int>& objects, const Camera& camera,
                                        const RadiositySettings& settings, Log& log);

/// Texels of one side of an object that are baked together: so many of its charts, from one of them on.
struct TexelRun {
  int object;
  bool back;
  size_t patch, texel, count;
};
/// All of them, in the order of objects, sides, patches and texels.
std::vector<TexelRun> texelRuns(std::span<const SurfaceCharts> surfaces);

/// visit(patch, texel) for each of a run.
template <class Visit>
void forEachTexel(std::span<const RadiosityChart> charts, const TexelRun& run, const Visit& visit) {
  size_t patch = run.patch, t = run.texel;
  for (size_t k = 0; k < run.count; ++k, ++t) {
    if (t == charts[patch].texelCount()) ++patch, t = 0;
    visit(static_cast<uint32_t>(patch), t);
  }
}

}  // namespace tomales

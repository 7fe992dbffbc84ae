#include "gi/photons/emission.h"

#include <numeric>

#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/base/simd.h"

namespace tomales {

// The map from square to disk is that of Shirley and Chiu (1997). It needs sines and cosines of at most an eighth of a
// turn, so short series are exact enough.
TOMALES_HOT void cosineHemispheres(std::span<const vec2> xi, std::span<vec3> out) {
  for (size_t i = 0; i < out.size(); ++i) {
    const float a = 2 * xi[i].x - 1, b = 2 * xi[i].y - 1;
    const bool swapped = std::abs(a) <= std::abs(b);
    const float r = swapped ? b : a, x = (kPi / 4) * (swapped ? a : b) / (r == 0 ? 1 : r), x2 = x * x;
    const float sine = x * (1 - x2 * (1.0f / 6 - x2 * (1.0f / 120 - x2 * (1.0f / 5040 - x2 * (1.0f / 362880)))));
    const float cosine = 1 - x2 * (0.5f - x2 * (1.0f / 24 - x2 * (1.0f / 720 - x2 * (1.0f / 40320))));
    out[i].x = r * (swapped ? sine : cosine);
    out[i].y = r * (swapped ? cosine : sine);
    out[i].z = std::sqrt(std::max(0.0f, 1 - r * r));
  }
}

StartNumbers startNumbers(uint32_t first, uint32_t stream, size_t count) {
  std::vector<uint32_t> number(count);
  std::iota(number.begin(), number.end(), first);
  const auto pairs = [&](uint32_t name) {
    std::vector<vec2> xi(count);
    sobol2(number, std::vector(count, name), xi);
    return xi;
  };
  return {pairs(stream), pairs(hashCombine(stream, randomStream("phot")))};
}

PhotonTarget::PhotonTarget(const Scene& scene) {
  for (const Object& o : scene.objects) {
    if (!o.attributes->visibility.photon) continue;
    for (uint32_t patch = 0; patch < o.shape().patchCount(); ++patch) {
      Bound3 swept;
      for (const PrimPtr& shape : o.shapes)
        for (const mat4& currentFromObject : o.currentFromObject.keys)
          swept.extend(transformBound(currentFromObject, shape->bound(patch, {})));
      patchBounds.push_back(swept.grown(o.displacementBound));
      bound.extend(patchBounds.back());
    }
  }
  if (bound.empty()) bound = {vec3(-1), vec3(1)};
}

}  // namespace tomales

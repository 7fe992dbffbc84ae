// Properties of compositing, for layers that RapidCheck makes up.
#include "tests/unit/image/frames.h"
#include "tests/unit/made_up.h"

namespace tomales {
namespace {

using test::madeUpVector;

constexpr int kSamples = 16;

std::vector<Layer> madeUpLayers(int most = 8) {
  std::vector<Layer> out(*test::wholeIn<size_t>(0, static_cast<size_t>(most) + 1));
  float z = 1;
  for (Layer& layer : out) {
    layer.opacity = madeUpVector(0, 1);
    layer.color = madeUpVector(0, 1) * layer.opacity;
    layer.z = z += 1;
    layer.samples = *test::wholeIn<uint64_t>(0, 1 << kSamples);
    layer.matte = *test::wholeIn(0, 8) == 0;
  }
  return out;
}

Image composited(const std::vector<Layer>& layers) {
  Options options = filtered("box", 1);
  options.opaqueThreshold = vec3(1.0f);  // Nothing is left out because hardly any light passes.
  return filterFrame(frameOf(layers, 1, 0, kSamples), options, jittered(kSamples, 1));
}

/// Returns the mean over samples of "over", layer by layer, in double precision (Porter and Duff 1984).
glm::dvec4 byHand(const std::vector<Layer>& layers) {
  glm::dvec4 sum(0.0);
  for (int sample = 0; sample < kSamples; ++sample) {
    glm::dvec3 clear(1.0);
    for (const Layer& layer : layers) {
      if ((layer.samples >> sample & 1) == 0) continue;
      const glm::dvec3 alpha = clear * glm::dvec3(layer.opacity);
      if (!layer.matte)
        sum += glm::dvec4(clear * glm::dvec3(layer.color), (alpha.x + alpha.y + alpha.z) / 3) / double{kSamples};
      clear -= alpha;
    }
  }
  return sum;
}

RC_GTEST_PROP(Compositing, IsOverOfTheLayersOfEachSample, ()) {
  const std::vector<Layer> layers = madeUpLayers();
  const Image image = composited(layers);
  for (int c = 0; c < 4; ++c) RC_ASSERT(std::abs(image.at(0, 0)[c] - byHand(layers)[c]) < 2e-6);
}

RC_GTEST_PROP(Compositing, DoesNotChangeWithLayersThatHaveNeitherColourNorOpacity, ()) {
  std::vector<Layer> layers = madeUpLayers();
  const Image before = composited(layers);
  const auto at = *test::wholeIn<size_t>(0, layers.size() + 1);
  const Layer nothing{vec3(0.0f), vec3(0.0f), at == 0 ? 1.0f : layers[at - 1].z, 0xffff};
  layers.insert(layers.begin() + static_cast<std::ptrdiff_t>(at), nothing);
  for (int c = 0; c < 4; ++c) RC_ASSERT(std::abs(composited(layers).at(0, 0)[c] - before.at(0, 0)[c]) < 1e-6f);
}

RC_GTEST_PROP(Compositing, LeavesOutWhatIsBehindAnOpaqueLayer, ()) {
  std::vector<Layer> layers = madeUpLayers();
  layers.push_back({vec3(0.5f), vec3(1.0f), 20, 0xffff});
  const Image before = composited(layers);
  layers.push_back({madeUpVector(0, 100), madeUpVector(0, 1), 30, *test::wholeIn<uint64_t>(0, 1 << kSamples)});
  for (int c = 0; c < 4; ++c) RC_ASSERT(composited(layers).at(0, 0)[c] == before.at(0, 0)[c]);
}

RC_GTEST_PROP(Compositing, IsLinearInTheColoursOfLayers, ()) {
  const std::vector<Layer> layers = madeUpLayers();
  std::vector<Layer> doubled = layers;
  for (Layer& layer : doubled) layer.color *= 2;
  for (int c = 0; c < 3; ++c) RC_ASSERT(composited(doubled).at(0, 0)[c] == 2 * composited(layers).at(0, 0)[c]);
  RC_ASSERT(composited(doubled).at(0, 0)[3] == composited(layers).at(0, 0)[3]);
}

}  // namespace
}  // namespace tomales

#include "gi/radiosity_bake.h"

#include "reyes/base/rng.h"
#include "reyes/dice.h"

namespace tomales {
namespace {

constexpr int kProbes = 4;          ///< Edges across a patch that its size is measured along.
constexpr uint32_t kManyPatches = 4096;  ///< Of an object: each is small then, and measured by its corners alone.
constexpr int kMostTexels = 2048;   ///< Along an edge.
constexpr int kSamples = 2;         ///< Along each edge of a texel.
constexpr float kShare = 1.0f / (kSamples * kSamples);
constexpr size_t kSamplesPerBatch = 1024;
constexpr uint32_t kBakeStream = 0x72616469U;

int powerOfTwoNear(float texels) {
  const float clamped = std::clamp(texels, 1.0f, static_cast<float>(kMostTexels));
  return 1 << static_cast<int>(std::lround(std::log2(clamped)));
}

/// Samples of texels on their way to be shaded together.
class Samples {
 public:
  explicit Samples(const RadiosityBake& bake) : bake_(bake), context_{RayKind::Diffuse, 1, bake.settings.seed, 1, false} {
    context_.diffuseLimit = 0;  // as where gather rays hit
    answers_.mode = HitMode::Shader;
  }

  /// A look at a point from `radius` in front of it; where its share of the colour goes, and its share of the texel if it has one.
  void add(const Ray& ray, const Hit& hit, SampleName name, vec3& sum, float& coverage) {
    rays_.push_back(ray), hits_.push_back(hit), names_.push_back(name), sums_.push_back(&sum), coverages_.push_back(&coverage);
    if (rays_.size() == kSamplesPerBatch) flush();
  }
  void flush() {
    bake_.rays.shadeHits(rays_, hits_, names_, bake_.shading, context_, answers_);
    for (size_t i = 0; i < sums_.size(); ++i)
      if (isFinite(answers_.color[i])) *sums_[i] += kShare * answers_.color[i], *coverages_[i] += kShare;
    rays_.clear(), hits_.clear(), names_.clear(), sums_.clear(), coverages_.clear();
  }

 private:
  const RadiosityBake& bake_;
  ShadeContext context_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<SampleName> names_;
  std::vector<vec3*> sums_;
  std::vector<float*> coverages_;
  HitAnswers answers_;
};

/// The quadrilateral on the surface of which a texel holds the mean.
struct Texel {
  int object;
  uint32_t patch;
  bool back;
  vec2 corner, size;  ///< In (u, v).
  float radius;       ///< Of what one sample stands for.
  uint32_t key;
};

void sample(const RadiosityBake& bake, const Texel& texel, Samples& samples, vec3& sum, float& coverage) {
  const Scene& scene = bake.rays.scene();
  const Object& object = scene.objects[static_cast<size_t>(texel.object)];
  for (int k = 0; k < kSamples * kSamples; ++k) {
    const uint32_t name = hashCombine(texel.key, static_cast<uint32_t>(k));
    const vec2 jitter{unitFloat(hash32(name)), unitFloat(hash32(name ^ 0x9e3779b9U))};
    const vec2 uv = texel.corner + texel.size * (vec2(k % kSamples, k / kSamples) + jitter) / float{kSamples};
    if (!object.shape().keeps(texel.patch, uv.x, uv.y)) continue;
    const TrueSurface surface = surfaceAt(scene, texel.object, texel.patch, uv.x, uv.y);
    const vec3 n = normalizeOr(surface.normal, vec3(0));
    if (n == vec3(0)) continue;
    const vec3 out = texel.back ? -n : n;
    Ray ray{surface.P + texel.radius * out, -out};
    ray.radius = texel.radius, ray.group = object.group;
    Hit hit;
    hit.t = texel.radius, hit.object = texel.object, hit.patch = texel.patch, hit.u = uv.x, hit.v = uv.y;
    hit.normal = hit.geometricNormal = n, hit.atOpen = surface.P;
    samples.add(ray, hit, {texel.key, static_cast<uint32_t>(k)}, sum, coverage);
  }
}

}  // namespace

RadiosityChart chartOf(const Scene& scene, const Camera& camera, int object, uint32_t patch, float texels) {
  const int probes = scene.objects[static_cast<size_t>(object)].shape().patchCount() > kManyPatches ? 1 : kProbes;
  vec3 at[kProbes + 1][kProbes + 1];
  vec3 middle(0);
  for (int j = 0; j <= probes; ++j)
    for (int i = 0; i <= probes; ++i) {
      at[j][i] = surfaceAt(scene, object, patch, static_cast<float>(i) / static_cast<float>(probes), static_cast<float>(j) / static_cast<float>(probes)).P;
      middle += at[j][i] / static_cast<float>((probes + 1) * (probes + 1));
    }
  float alongU = 0, alongV = 0;
  for (int j = 0; j <= probes; ++j) {
    float u = 0, v = 0;
    for (int i = 0; i < probes; ++i) u += glm::length(at[j][i + 1] - at[j][i]), v += glm::length(at[i + 1][j] - at[i][j]);
    alongU = std::max(alongU, u), alongV = std::max(alongV, v);
  }
  const Attributes::Radiosity& asked = scene.objects[static_cast<size_t>(object)].attributes->radiosity;
  // By its distance, so that what the camera does not see is no coarser than what it sees as far away.
  const float unit = asked.screen ? camera.pixelSize({0, 0, glm::length(middle)}) : std::cbrt(std::abs(glm::determinant(mat3(scene.cameraFromWorldAtOpen()))));
  const float texel = std::max(asked.texelSize * unit / texels, 1e-12f);
  RadiosityChart chart;
  chart.width = powerOfTwoNear(alongU / texel), chart.height = powerOfTwoNear(alongV / texel);
  chart.texelSize = std::max(std::sqrt(alongU / static_cast<float>(chart.width) * alongV / static_cast<float>(chart.height)), 1e-20f);
  return chart;
}

void bakeTexels(const RadiosityBake& bake, int object, bool back, std::span<RadiosityChart> charts, const TexelRun& run) {
  const auto forEach = [&](const auto& visit) {
    size_t patch = run.patch, t = run.texel;
    for (size_t k = 0; k < run.count; ++k, ++t) {
      if (t == charts[patch].texels.size()) ++patch, t = 0;
      visit(static_cast<uint32_t>(patch), t);
    }
  };
  Samples samples(bake);
  forEach([&](uint32_t patch, size_t t) {
    RadiosityChart& chart = charts[patch];
    const vec2 size = 1.0f / vec2(chart.width, chart.height);
    const vec2 cell(static_cast<float>(t % static_cast<size_t>(chart.width)), static_cast<float>(t / static_cast<size_t>(chart.width)));
    const uint32_t key = hashCombine(hashCombine(kBakeStream, static_cast<uint32_t>(object), patch), static_cast<uint32_t>(t));
    sample(bake, {object, patch, back, cell * size, size, 0.5f * chart.texelSize / kSamples, key}, samples, chart.texels[t], chart.coverage[t]);
  });
  samples.flush();
  forEach([&](uint32_t patch, size_t t) {
    RadiosityChart& chart = charts[patch];
    if (chart.coverage[t] > 0) chart.texels[t] /= chart.coverage[t];
  });
}

}  // namespace tomales

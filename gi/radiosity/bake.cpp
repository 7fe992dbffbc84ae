#include "gi/radiosity/bake.h"

#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/dice.h"

namespace tomales {
namespace {

constexpr int kSamples = 2;  ///< Samples along each edge of a texel.
constexpr size_t kSamplesPerBatch = 1024;

/// Collects samples of texels, to shade many together.
class Samples {
 public:
  explicit Samples(const RadiosityBake& bake)
      : bake_(bake), context_{RayKind::Diffuse, 1, bake.settings.seed, 1, false} {
    context_.diffuseLimit = 0;  // the same as where gather rays hit
    question_.mode = HitMode::Shader;
  }

  /// Adds a sample: a ray that sees a point of the texel. If the colour that it brings is finite, its share goes to
  /// `sum`.
  void add(const Ray& ray, const Hit& hit, SampleName name, BakedTexel& sum) {
    rays_.push_back(ray);
    hits_.push_back(hit);
    names_.push_back(name);
    sums_.push_back(&sum);
    if (rays_.size() == kSamplesPerBatch) flush();
  }
  void flush() {
    bake_.rays.shadeHits(rays_, hits_, names_, bake_.shading, context_, question_, answers_);
    constexpr float share = 1.0f / (kSamples * kSamples);
    for (size_t i = 0; i < sums_.size(); ++i)
      if (isFinite(answers_.color[i])) {
        sums_[i]->radiance += share * answers_.color[i];
        sums_[i]->coverage += share;
      }
    rays_.clear();
    hits_.clear();
    names_.clear();
    sums_.clear();
  }

 private:
  const RadiosityBake& bake_;
  ShadeContext context_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  std::vector<SampleName> names_;
  std::vector<BakedTexel*> sums_;
  HitQuestion question_;
  HitAnswers answers_;
};

/// A quadrilateral of the surface, whose mean a texel holds.
struct Texel {
  int object;
  uint32_t patch;
  bool back;
  TexelSquare square;
  float radius;  ///< Radius of the area that one sample stands for.
  uint32_t key;
};

void sample(const RadiosityBake& bake, const Texel& texel, Samples& samples, BakedTexel& sum) {
  const Scene& scene = bake.rays.scene();
  const Object& object = scene.objects[static_cast<size_t>(texel.object)];
  for (int k = 0; k < kSamples * kSamples; ++k) {
    const uint32_t name = hashCombine(texel.key, static_cast<uint32_t>(k));
    const vec2 jitter{unitFloat(hash32(name)), unitFloat(hash32(name ^ randomStream("second")))};
    const vec2 uv =
        texel.square.corner + texel.square.size * (vec2(k % kSamples, k / kSamples) + jitter) / float{kSamples};
    if (!object.shape().keeps(texel.patch, uv.x, uv.y)) continue;
    const TrueSurface surface = surfaceAt(scene, texel.object, texel.patch, uv.x, uv.y);
    const vec3 n = normalizeOr(surface.normal, vec3(0));
    if (n == vec3(0)) continue;
    const vec3 out = texel.back ? -n : n;
    Ray ray{surface.P + texel.radius * out, -out};
    ray.radius = texel.radius;
    ray.group = object.group;
    Hit hit = hitOn(texel.object, texel.patch, uv, surface.P, n, n);
    hit.t = texel.radius;
    samples.add(ray, hit, {texel.key, static_cast<uint32_t>(k)}, sum);
  }
}

}  // namespace

TexelSquare texelSquare(const RadiosityChart& chart, size_t t) {
  const vec2 size = 1.0f / vec2(chart.width, chart.height);
  const vec2 cell(static_cast<float>(t % static_cast<size_t>(chart.width)),
                  static_cast<float>(t / static_cast<size_t>(chart.width)));
  return {cell * size, size};
}

std::vector<BakedTexel> bakeTexels(const RadiosityBake& bake, std::span<const RadiosityChart> charts,
                                   const TexelRun& run) {
  std::vector<BakedTexel> out;
  out.reserve(run.count);  // samples keep pointers to them
  Samples samples(bake);
  forEachTexel(charts, run, [&](uint32_t patch, size_t t) {
    const RadiosityChart& chart = charts[patch];
    const uint32_t key = hashCombine(hashCombine(randomStream("radi"), static_cast<uint32_t>(run.object), patch),
                                     static_cast<uint32_t>(t));
    sample(bake, {run.object, patch, run.back, texelSquare(chart, t), 0.5f * chart.texelSize / kSamples, key}, samples,
           out.emplace_back());
  });
  samples.flush();
  for (BakedTexel& texel : out)
    if (texel.coverage > 0) texel.radiance /= texel.coverage;
  return out;
}

}  // namespace tomales

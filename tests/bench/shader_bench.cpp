// A procedural shader (8 octaves of noise, 3 lights, plastic) written with reyes/sl.h, over a loop of the same
// arithmetic that knows everything beforehand. Prints ratios of interleaved runs.
#include <fmt/format.h>

#include <cstdio>
#include <ctime>

#include "reyes/dice.h"
#include "reyes/rib.h"
#include "reyes/shade.h"
#include "reyes/shader_registry.h"
#include "reyes/sl.h"

namespace {

using namespace tomales;
constexpr int kPoints = 65536, kOctaves = 8;

struct procedural : sl::Surface {
  void main() {
    using namespace sl;
    Float sum = 0;
    Point Q = 4 * P;
    for (int k = 0; k < kOctaves; ++k) {
      sum += std::exp2(-static_cast<float>(k)) * noise(Q);
      Q *= Float(2);
    }
    Normal Nf = faceforward(normalize(N), I);
    Oi = Os;
    Ci = Os * (sum * Cs * (ambient() + 0.5 * diffuse(Nf)) + 0.5 * specular(Nf, -normalize(I), 0.1));
  }
};
const rsl::Shader shader(TM_SURFACE, "procedural", "", TM_KEEPS_OPACITY, sl::shade<procedural>, {});

const rsl::Vec3 kLights[3] = {{0.3f, -0.2f, -1}, {-0.5f, -0.5f, -1}, {0, 0.7f, -1}};

RSL_HOT void noiseLoop(int n, const float* x, const float* y, const float* z, float* __restrict sum) {
  for (int i = 0; i < n; ++i) sum[i] = 0;
  for (int k = 0; k < kOctaves; ++k) {
    const float scale = 4 * std::exp2(static_cast<float>(k)), weight = std::exp2(-static_cast<float>(k));
    for (int i = 0; i < n; ++i)
      sum[i] += weight * (0.5f + 0.5f * rsl::signedNoise({scale * x[i], scale * y[i], scale * z[i]}));
  }
}

void handLoop(const ShadePoints& p, std::vector<float>& sum, ShadedPoints& out) {
  constexpr int kChunk = 256;
  const rsl::Vec3 lights[3] = {rsl::normalize(kLights[0]), rsl::normalize(kLights[1]), rsl::normalize(kLights[2])};
  for (int first = 0; first < p.count(); first += kChunk) {
    const int n = std::min(kChunk, p.count() - first);
    noiseLoop(n, p.channel(kPx) + first, p.channel(kPy) + first, p.channel(kPz) + first, sum.data());
    for (int i = 0; i < n; ++i) {
      const auto get = [&](int c) {
        return rsl::Vec3{p.channel(c)[first + i], p.channel(c + 1)[first + i], p.channel(c + 2)[first + i]};
      };
      const rsl::Vec3 N = rsl::faceforward(rsl::normalize(get(kNx)), get(kIx), get(kNgx)),
                      V = -rsl::normalize(get(kIx));
      float diffuse = 0, specular = 0;
      for (const rsl::Vec3& L : lights) {
        const float cosine = rsl::dot(N, L);
        if (cosine <= 0) continue;
        diffuse += cosine;
        specular += std::pow(std::max(0.0f, rsl::dot(N, rsl::normalize(L + V))), 80.0f);
      }
      const float c = sum[static_cast<size_t>(i)] * 0.5f * diffuse + 0.5f * specular;
      for (auto& channel : out.Ci) channel[static_cast<size_t>(first + i)] = c;
      for (auto& channel : out.Oi) channel[static_cast<size_t>(first + i)] = 1;
    }
  }
}

/// The processor time of the call, so that what else runs on the machine counts little.
template <class Call>
double secondsOf(const Call& call) {
  const std::clock_t start = std::clock();
  call();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace

int main() {
  Log log;
  Stats stats;
  ShaderRegistry registry(log);
  registry.addLibrary(tomales_builtin_shaders(), "built-in");
  static const TmShader* const shaders[] = {shader};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "bench");
  std::string text = "Projection \"perspective\"\nWorldBegin\n";
  for (int k = 0; k < 3; ++k)
    text += fmt::format("LightSource \"distantlight\" {} \"from\" [{} {} {}] \"to\" [0 0 0]\n", k, kLights[k].x,
                        kLights[k].y, kLights[k].z);
  text += "Surface \"procedural\"\nTranslate 0 0 5\nSphere 2 -2 2 360\nWorldEnd\n";
  RibSettings rib;
  rib.onScene = [&](Scene&& scene) {
    const ShadingSystem shading(scene, registry, nullptr, log, stats);
    ShadePoints points(0, 0);
    for (int i = 0; i < kPoints; ++i) {
      points.add(static_cast<uint32_t>(i));
      evaluatePoint(scene, 0, 0, 0.5f + 0.4f * static_cast<float>(i % 256) / 256, static_cast<float>(i / 256) / 256,
                    points, i);
      points.set3(kIx, i, points.position(i));
    }
    ShadedPoints ours, theirs;
    theirs.resize(kPoints);
    std::vector<float> sum(512);
    for (int run = 0; run < 6; ++run) {
      const double a = secondsOf([&] { shading.shade(points, {}, ours); }),
                   b = secondsOf([&] { handLoop(points, sum, theirs); });
      float worst = 0;
      for (int i = 0; i < kPoints; ++i) worst = std::max(worst, std::abs(ours.color(i).x - theirs.color(i).x));
      std::puts(fmt::format("{:.0f} ns a point, hand-written {:.0f} ns: {:.0f} % of its speed (difference {:.1g})",
                            1e9 * a / kPoints, 1e9 * b / kPoints, 100 * b / a, worst)
                    .c_str());
    }
  };
  return readRibText(text, "bench", rib, log) ? 0 : 1;
}

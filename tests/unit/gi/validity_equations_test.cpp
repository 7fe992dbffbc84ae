// The irradiance cache against its equations, written down once more in double precision and without a tree: what of
// Tabellion and Lamorlette 2004 (eq. 2 to 7) and Ward et al. (1988) is used, and what docs/gi.md says was added.
#include <gtest/gtest.h>

#include "gi/irradiance_cache.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace cache_equations {
namespace {

using Triple = glm::dvec3;

double luminanceOf(const Triple& c) { return luminance(vec3(c)); }

bool isAsPublished(ErrorFunction function) {
  return function == ErrorFunction::Split || function == ErrorFunction::Plain;
}

struct Equations {
  CacheSettings settings;
  std::vector<IrradianceRecord> records;
  const bool splitSphere =
      settings.errorFunction == ErrorFunction::Ward || settings.errorFunction == ErrorFunction::Split;
  const bool curvature = settings.errorFunction == ErrorFunction::Hessian;
  const bool asPublished = isAsPublished(settings.errorFunction);
  double kappa = settings.kappa;

  double size(const IrradianceRecord& r) const {
    if (splitSphere) return r.harmonicMean;
    return curvature ? std::min<double>(r.smoothRadius, r.closest * kappa) : r.closest / 2.0;
  }
  double reach(const IrradianceRecord& r, double pixel) const {
    return std::max(std::min(size(r), settings.maxPixels * pixel), settings.minPixels * pixel) / kappa;
  }
  double weight(const IrradianceRecord& r, const vec3& x, const vec3& n, double pixel, double wider) const {
    const Triple step = Triple(x) - Triple(r.position), ni = r.normal, turned = n;
    const double covers = reach(r, pixel);
    const Triple change = covers * Triple(r.light.translationGradient[0] + r.light.translationGradient[1] +
                                          r.light.translationGradient[2]);
    const double even =
        1 - std::min(1.0, dot(change, change) / std::pow(0.3 * (r.light.E.x + r.light.E.y + r.light.E.z), 2));
    const double radius = std::min<double>(covers * (1 + (wider - 1) * even), r.limit), distance = glm::length(step);
    const double tolerance = std::max<double>(std::min(0.1 * radius, 0.45 * pixel / kappa), r.unseenDisplacement);
    const double behind = std::max(0.0, -dot(step, turned + ni) / 2 / tolerance);
    // A record that was limited ends before the place that limited it, whatever the distance is rounded to.
    if (distance >= radius * (1 - 1e-6) || behind >= 1) return 0;
    const double fades = 1 - behind, angle = std::sqrt(std::max(0.0, 1 - dot(turned, ni)));
    if (splitSphere) return fades * std::max(0.0, 1 / std::max(distance / radius + kappa * angle, 1e-4) - 1);
    return fades * std::max(0.0, 1 - std::max(distance / radius, kappa * angle / std::sqrt(1 - std::cos(kPi / 18))));
  }
  static Triple change(const IrradianceRecord& r, const Triple& step, const Triple& turn) {
    Triple out;
    for (int c = 0; c < 3; ++c)
      out[c] = dot(turn, Triple(r.light.rotationGradient[c])) + dot(step, Triple(r.light.translationGradient[c]));
    return out;
  }
  static Triple changeAt(const IrradianceRecord& r, const vec3& x, const vec3& n) {
    return change(r, Triple(x) - Triple(r.position), cross(Triple(r.normal), Triple(n)));
  }
  static Triple lightAt(const IrradianceRecord& r, const vec3& x, const vec3& n) {
    return glm::max(Triple(0), Triple(r.light.E) + changeAt(r, x, n));
  }
  static double noiseAt(const IrradianceRecord& r, const vec3& x) {
    return r.noise * (1 + glm::length(Triple(x) - Triple(r.position)) / r.harmonicMean);
  }
  /// Returns 0 if there is none, 1 if light is steep, 2 if different surfaces are seen.
  int disagreement(const Triple& a, const Triple& b, double noise) const {
    double sum = 0;
    for (const IrradianceRecord& r : records) sum += luminanceOf(r.light.E);
    const double off = std::abs(luminanceOf(a) - luminanceOf(b)) - 3 * noise,
                 scale = std::max({luminanceOf(a), luminanceOf(b), 0.1 * sum / static_cast<double>(records.size())});
    if (asPublished || off <= (splitSphere ? 0.4 : 0.1) / kappa * scale) return 0;
    return off > 0.5 * scale ? 2 : 1;
  }
  double limitBy(int disagreement, double distance, double pixel) const {
    return disagreement == 0 ? kInfinity : disagreement == 2 ? distance : std::max(distance, pixel / kappa);
  }
  void insert(IrradianceRecord fresh) {
    const double radius = reach(fresh, fresh.pixelSize);
    for (int c = 0; c < 3; ++c) {
      const double steep = glm::length(Triple(fresh.light.translationGradient[c])) * radius;
      if (steep > fresh.light.E[c]) fresh.light.translationGradient[c] *= static_cast<float>(fresh.light.E[c] / steep);
      const double xx = fresh.light.hessian[0][c], xy = fresh.light.hessian[1][c], yy = fresh.light.hessian[2][c];
      const double bend = radius * radius / 2 * std::sqrt(xx * xx + 2 * xy * xy + yy * yy);
      for (vec3& second : fresh.light.hessian)
        if (bend > fresh.light.E[c]) second[c] *= static_cast<float>(fresh.light.E[c] / bend);
    }
    records.push_back(fresh);
    for (size_t i = 0; i + 1 < records.size(); ++i) {
      IrradianceRecord &a = records[i], &b = records.back();
      if (weight(a, b.position, b.normal, b.pixelSize, 1) <= 0) continue;
      const double apart = glm::length(Triple(a.position) - Triple(b.position));
      const int ofA = disagreement(lightAt(a, b.position, b.normal), b.light.E, noiseAt(a, b.position) + b.noise),
                ofB = disagreement(lightAt(b, a.position, a.normal), a.light.E, noiseAt(b, a.position) + a.noise);
      a.limit = std::min(a.limit, static_cast<float>(limitBy(ofA, apart, a.pixelSize)));
      b.limit = std::min(b.limit, static_cast<float>(limitBy(ofB, apart, b.pixelSize)));
    }
  }
  IrradianceEstimate lookup(const IrradiancePlace& at, double wider) const {
    std::vector<std::pair<const IrradianceRecord*, double>> used;
    double W = 0;
    for (const IrradianceRecord& r : records)
      if (const double w = weight(r, at.position, at.normal, at.pixelSize, wider); w > 0) {
        used.emplace_back(&r, w);
        W += w;
      }
    IrradianceEstimate out{};
    out.weight = static_cast<float>(W);
    if (W == 0) return out;
    Triple E(0), squares(0), step(0), turn(0), changes(0), dominant[3] = {Triple(0), Triple(0), Triple(0)};
    IrradianceRecord mean{};
    double before = 0, nearest = kInfinity;
    int worst = 0;
    for (const auto& [r, w] : used) {
      const Triple light = lightAt(*r, at.position, at.shadingNormal);
      const double distance = glm::length(Triple(at.position) - Triple(r->position));
      if (before > 0) worst = std::max(worst, disagreement(light, E / before, 2 * noiseAt(*r, at.position)));
      before += w;
      E += w * light;
      squares += w * light * light;
      step += w / W * (Triple(at.position) - Triple(r->position));
      turn += w / W * cross(Triple(r->normal), Triple(at.shadingNormal));
      changes += w / W * changeAt(*r, at.position, at.shadingNormal);
      for (int c = 0; c < 3; ++c) {
        mean.light.translationGradient[c] += static_cast<float>(w / W) * r->light.translationGradient[c];
        mean.light.rotationGradient[c] += static_cast<float>(w / W) * r->light.rotationGradient[c];
        dominant[c] += w * Triple(r->dominant[c]);
      }
      nearest = std::min(nearest, distance);
      out.closest = std::min(out.closest, r->closest);
      out.occluderHeight = std::min(out.occluderHeight, std::max(r->closest, r->limit));
      out.hasRecord = out.hasRecord || distance == 0;
    }
    E /= W;
    const Triple variance = squares / W - E * E;
    const Triple agreement = glm::clamp(1.0 - variance / glm::max(0.09 * E * E, Triple(1e-30)), Triple(0), Triple(1));
    Triple second = -0.5 * (changes - change(mean, step, turn));
    if (curvature)
      for (const auto& [r, w] : used) {
        const Triple known = step * std::min(1.0, reach(*r, at.pixelSize) / glm::length(step));
        const double a = dot(known, Triple(r->tangent)), b = dot(known, cross(Triple(r->normal), Triple(r->tangent)));
        second += w / W / 2 *
                  (a * a * Triple(r->light.hessian[0]) + 2 * a * b * Triple(r->light.hessian[1]) +
                   b * b * Triple(r->light.hessian[2]));
      }
    out.E = vec3(glm::max(Triple(0), E + (asPublished ? Triple(0) : agreement * second)));
    out.inconsistent = limitBy(worst, nearest, at.pixelSize) <= nearest;
    for (int c = 0; c < 3; ++c) out.dominant[c] = vec3(glm::normalize(dominant[c]));
    return out;
  }
};

vec3 randomIn(uint32_t i, uint32_t salt) {
  const auto number = [&](uint32_t axis) { return 2 * unitFloat(hashCombine(i, salt, axis)) - 1; };
  return {number(0), number(1), number(2)};
}

float randomBetween(float least, float most, uint32_t i, uint32_t salt) {
  return lerp(least, most, unitFloat(hashCombine(i, salt)));
}

/// Records of a bumpy floor whose light changes, some of them noisy, and a few with light that has nothing to do with
/// that of the others.
IrradianceRecord record(uint32_t i) {
  IrradianceRecord r{};
  r.position = randomIn(i, 1) * vec3(1, 1, 0.004f);
  r.normal = glm::normalize(vec3(0, 0, 1) + 0.06f * randomIn(i, 2));
  r.light.E = vec3(1, 0.5f, 2) + 0.3f * r.position.x + 0.06f * randomIn(i, 3);
  if (i % 17 == 0) r.light.E *= 4;
  if (i % 23 == 0) r.light.E = vec3(0.02f);
  for (uint32_t c = 0; c < 3; ++c) {
    r.light.rotationGradient[c] = 0.2f * randomIn(i, 4 + c);
    r.light.translationGradient[c] = vec3(0.3f, 0, 0) + (i % 7 == 0 ? 60.0f : 0.6f) * randomIn(i, 7 + c);
    r.light.hessian[c] = (i % 5 == 0 ? 400.0f : 2.0f) * randomIn(i, 10 + c);
    r.dominant[c] = glm::normalize(vec3(0, 0, 1) + randomIn(i, 13 + c));
  }
  r.tangent = normalizeOr(cross(r.normal, randomIn(i, 16)), vec3(1, 0, 0));
  r.closest = std::pow(10.0f, randomBetween(-2, 0.5f, i, 17));
  r.harmonicMean = r.closest * randomBetween(1, 3, i, 18);
  r.smoothRadius = randomBetween(0.02f, 0.4f, i, 19);
  r.noise = i % 3 == 0 ? randomBetween(0, 0.05f, i, 20) : 0;
  r.pixelSize = randomBetween(0.01f, 0.04f, i, 21);
  r.unseenDisplacement = i % 11 == 0 ? 0.01f : 0;
  return r;
}

struct Kind {
  CacheSettings settings;
  const char* name;
};

const Kind kKinds[] = {{{ErrorFunction::Screen, 1}, "screen"},
                       {{ErrorFunction::Screen, 2, 6, 1}, "screen of kappa 2"},
                       {{ErrorFunction::Ward, 4}, "ward"},
                       {{ErrorFunction::Hessian, 0.87f, 40}, "hessian"},
                       {{ErrorFunction::Hessian, 2, 40}, "hessian of kappa 2"},
                       {{ErrorFunction::Split, 4, kInfinity, 0}, "split"},
                       {{ErrorFunction::Plain, 1}, "plain"}};

IrradiancePlace place(uint32_t i, const IrradianceCache& cache) {
  const vec3 normal = glm::normalize(vec3(0, 0, 1) + 0.05f * randomIn(i, 30));
  const vec3 anywhere = randomIn(i, 31) * vec3(1, 1, 0.01f);
  return {i % 10 == 0 ? cache.records()[i].position : anywhere, normal, glm::normalize(normal + 0.1f * randomIn(i, 32)),
          randomBetween(0.01f, 0.04f, i, 33)};
}

TEST(CacheEquations, SayHowFarEachRecordIsValid) {
  for (const Kind& kind : kKinds) {
    IrradianceCache cache({vec3(-0.9f), vec3(0.9f)}, kind.settings);
    Equations plain{kind.settings, {}};
    for (uint32_t i = 0; i < 400; ++i) {
      cache.insert(record(i));
      plain.insert(record(i));
    }
    int limited = 0;
    for (size_t i = 0; i < 400; ++i) {
      const IrradianceRecord &a = cache.records()[i], &b = plain.records[i];
      EXPECT_FLOAT_EQ(a.limit, b.limit) << kind.name << ' ' << i;
      for (size_t c = 0; c < 3; ++c) {
        EXPECT_LT(glm::length(a.light.translationGradient[c] - b.light.translationGradient[c]),
                  1e-4f * (1 + glm::length(b.light.translationGradient[c])));
        EXPECT_LT(glm::length(a.light.hessian[c] - b.light.hessian[c]), 1e-4f * (1 + glm::length(b.light.hessian[c])));
      }
      limited += a.limit < kInfinity;
    }
    EXPECT_EQ(limited > 30, !isAsPublished(kind.settings.errorFunction)) << kind.name << ' ' << limited;
  }
}

TEST(CacheEquations, DimLightHasTheLimitsOfBrightLight) {
  for (const Kind& kind : kKinds) {
    IrradianceCache bright({vec3(-0.9f), vec3(0.9f)}, kind.settings), dim({vec3(-0.9f), vec3(0.9f)}, kind.settings);
    for (uint32_t i = 0; i < 100; ++i) {
      IrradianceRecord r = record(i);
      bright.insert(r);
      const float scale = std::exp2(-20.0f);
      r.light.E *= scale;
      r.noise *= scale;
      for (size_t c = 0; c < 3; ++c) {
        r.light.translationGradient[c] *= scale;
        r.light.rotationGradient[c] *= scale;
        r.light.hessian[c] *= scale;
      }
      dim.insert(r);
    }
    for (size_t i = 0; i < 100; ++i) EXPECT_EQ(bright.records()[i].limit, dim.records()[i].limit) << kind.name;
  }
}

TEST(CacheEquations, SayWhatALookupFinds) {
  for (const Kind& kind : kKinds)
    for (const float wider : {1.0f, 1.25f}) {
      IrradianceCache cache({vec3(-0.9f), vec3(0.9f)}, kind.settings);
      for (uint32_t i = 0; i < 400; ++i) cache.insert(record(i));
      const Equations plain{kind.settings, {cache.records().begin(), cache.records().end()}};
      int found = 0, inconsistent = 0;
      for (uint32_t i = 0; i < 300; ++i) {
        const IrradiancePlace at = place(i, cache);
        IrradianceEstimate a;
        cache.lookup({&at, 1}, &a, wider);
        const IrradianceEstimate b = plain.lookup(at, plain.asPublished || plain.curvature ? 1 : wider);
        EXPECT_NEAR(a.weight, b.weight, 1e-3f * (1 + b.weight)) << kind.name << ' ' << i;
        if (b.weight < 0.01f) continue;
        ++found;
        inconsistent += b.inconsistent;
        EXPECT_LT(glm::length(a.E - b.E), 2e-3f * (1 + glm::length(b.E))) << kind.name << ' ' << i;
        for (int c = 0; c < 3; ++c) EXPECT_GT(dot(a.dominant[c], b.dominant[c]), 0.9999f);
        EXPECT_EQ(a.closest, b.closest);
        EXPECT_EQ(a.occluderHeight, b.occluderHeight);
        EXPECT_EQ(a.hasRecord, b.hasRecord);
        EXPECT_EQ(a.inconsistent, b.inconsistent) << kind.name << ' ' << i;
      }
      EXPECT_GT(found, 100) << kind.name;
      EXPECT_EQ(inconsistent > 3, !plain.asPublished) << kind.name << ' ' << inconsistent;
    }
}

TEST(CacheEquations, ARestoredCacheAnswersAsTheFirstDid) {
  for (const Kind& kind : kKinds) {
    IrradianceCache first({vec3(-0.9f), vec3(0.9f)}, kind.settings), again({vec3(-0.9f), vec3(0.9f)}, kind.settings);
    for (uint32_t i = 0; i < 400; ++i) first.insert(record(i));
    for (const IrradianceRecord& r : first.records()) again.restore(r);
    for (uint32_t i = 0; i < 300; ++i) {
      const IrradiancePlace at = place(i, first);
      const auto a = first.lookup(at.position, at.normal, at.shadingNormal, at.pixelSize),
                 b = again.lookup(at.position, at.normal, at.shadingNormal, at.pixelSize);
      EXPECT_TRUE(a.E == b.E && a.weight == b.weight && a.inconsistent == b.inconsistent) << kind.name << ' ' << i;
    }
  }
}

TEST(CacheEquations, SharesThatAreFractionsOfTheLightGiveThatFractionOfIt) {
  const vec3 fractions[] = {{0.25f, 0.5f, 0.125f}, {0.75f, 0.5f, 0.875f}}, gains[] = {{2, 0, 4}, {1, 3, 0}};
  for (const Kind& kind : kKinds) {
    IrradianceCache cache({vec3(-0.9f), vec3(0.9f)}, kind.settings);
    for (uint32_t i = 0; i < 400; ++i) {
      IrradianceRecord r = record(i);
      for (const vec3& fraction : fractions) r.shares.emplace_back().add(r.light, fraction);
      cache.insert(r);
    }
    const std::vector<IrradianceExpansion> light = cache.mixed(gains);
    ASSERT_EQ(light.size(), 400u);
    const vec3 all = fractions[0] * gains[0] + fractions[1] * gains[1];
    for (uint32_t i = 0; i < 300; ++i) {
      const IrradiancePlace at = place(i, cache);
      IrradianceEstimate once, changed;
      cache.lookup({&at, 1}, &once);
      cache.lookup({&at, 1}, &changed, 1, light);
      EXPECT_EQ(changed.weight, once.weight);
      EXPECT_LT(glm::length(changed.E - all * once.E), 1e-4f * (1 + glm::length(once.E))) << kind.name << ' ' << i;
      const auto single = cache.lookup(at.position, at.normal, at.shadingNormal, at.pixelSize, light);
      EXPECT_EQ(single.E, changed.E);
    }
    IrradianceRecord r = cache.records()[3];
    r.noise = 0.01f;
    const IrradianceRecord brighter = withGains(r, gains);
    EXPECT_LT(glm::length(brighter.light.E - all * r.light.E), 1e-4f);
    EXPECT_FLOAT_EQ(brighter.noise, 4 * r.noise) << "no share is brighter by more";
    for (int c = 0; c < 3; ++c) {
      EXPECT_LT(glm::length(brighter.light.translationGradient[c] - all[c] * r.light.translationGradient[c]), 1e-4f);
      EXPECT_LT(glm::length(brighter.light.rotationGradient[c] - all[c] * r.light.rotationGradient[c]), 1e-4f);
      EXPECT_LT(glm::length(brighter.light.hessian[c] - all * r.light.hessian[c]), 1e-2f);
      EXPECT_LT(glm::length(brighter.shares[0].E - gains[0] * r.shares[0].E), 1e-4f);
    }
  }
}

}  // namespace
}  // namespace cache_equations
}  // namespace tomales

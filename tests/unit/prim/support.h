// Sampling of primitives, and the properties that all of them share.
#pragma once
#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "reyes/prim_factories.h"

namespace tomales::test {

struct Sample {
  vec3 p, du, dv, n;
};

inline std::vector<Sample> samplesAt(const Prim& prim, uint32_t patch, const std::vector<float>& u,
                                     const std::vector<float>& v) {
  const size_t n = u.size();
  std::vector<float> f[12];
  for (auto& array : f) array.assign(n, NAN);
  prim.evaluate(patch, static_cast<int>(n), u.data(), v.data(),
                {f[0].data(), f[1].data(), f[2].data(), f[3].data(), f[4].data(), f[5].data(), f[6].data(), f[7].data(),
                 f[8].data(), f[9].data(), f[10].data(), f[11].data()});
  std::vector<Sample> out(n);
  for (size_t i = 0; i < n; ++i)
    out[i] = {{f[0][i], f[1][i], f[2][i]},
              {f[3][i], f[4][i], f[5][i]},
              {f[6][i], f[7][i], f[8][i]},
              {f[9][i], f[10][i], f[11][i]}};
  return out;
}

inline Sample sampleAt(const Prim& prim, uint32_t patch, float u, float v) {
  return samplesAt(prim, patch, {u}, {v})[0];
}

inline std::vector<float> primvarAt(const Prim& prim, uint32_t patch, int index, float u, float v) {
  std::vector<float> out(static_cast<size_t>(prim.primvars()[static_cast<size_t>(index)].width), NAN);
  prim.interpolate(patch, index, 1, &u, &v, out.data(), 1);
  return out;
}

/// Area of the surface diced into side x side quadrilaterals a patch.
inline double dicedArea(const Prim& prim, int side) {
  double area = 0;
  for (uint32_t patch = 0; patch < prim.patchCount(); ++patch) {
    std::vector<float> u, v;
    for (int j = 0; j <= side; ++j)
      for (int i = 0; i <= side; ++i) {
        u.push_back(static_cast<float>(i) / side);
        v.push_back(static_cast<float>(j) / side);
      }
    const std::vector<Sample> s = samplesAt(prim, patch, u, v);
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const glm::dvec3 a = s[j * (side + 1) + i].p, b = s[j * (side + 1) + i + 1].p;
        const glm::dvec3 c = s[(j + 1) * (side + 1) + i].p, d = s[(j + 1) * (side + 1) + i + 1].p;
        area += 0.5 * (glm::length(glm::cross(b - a, c - a)) + glm::length(glm::cross(b - d, c - d)));
      }
  }
  return area;
}

/// Halving the step divides the error by about four, and the finest is right to a thousandth.
inline void expectAreaAtSecondOrder(const Prim& prim, double area) {
  const double coarse = std::abs(dicedArea(prim, 16) - area), fine = std::abs(dicedArea(prim, 64) - area);
  EXPECT_LT(fine, 2e-3 * area);
  EXPECT_LT(fine, std::max(coarse / 12, 1e-6 * area));
}

/// Derivatives agree with central differences, and the normal with their cross product.
inline void expectDerivativesOfPositions(const Prim& prim, float tolerance) {
  constexpr float h = 1.0f / 256;
  for (uint32_t patch = 0; patch < prim.patchCount(); ++patch)
    for (float u : {0.1f, 0.37f, 0.5f, 0.83f})
      for (float v : {0.15f, 0.41f, 0.77f}) {
        const Sample s = sampleAt(prim, patch, u, v);
        const vec3 du = (sampleAt(prim, patch, u + h, v).p - sampleAt(prim, patch, u - h, v).p) / (2 * h);
        const vec3 dv = (sampleAt(prim, patch, u, v + h).p - sampleAt(prim, patch, u, v - h).p) / (2 * h);
        EXPECT_LT(glm::length(s.du - du), tolerance * (1 + glm::length(du))) << patch << ' ' << u << ' ' << v;
        EXPECT_LT(glm::length(s.dv - dv), tolerance * (1 + glm::length(dv))) << patch << ' ' << u << ' ' << v;
        EXPECT_GT(dot(glm::normalize(s.n), glm::normalize(cross(s.du, s.dv))), 0.9999f)
            << patch << ' ' << u << ' ' << v;
      }
}

/// bound() of random rectangles contains random points of them: `total` points in all. On average it is larger than the
/// box around these by less than `slack` of its size.
inline void expectBoundsContainTheSurface(const Prim& prim, int total = 10000, float slack = 0.5f) {
  constexpr int kPoints = 50;
  ASSERT_GT(prim.patchCount(), 0u);
  Bound3 whole;
  for (uint32_t patch = 0; patch < prim.patchCount(); ++patch) whole.extend(prim.bound(patch, {}));
  int outside = 0;
  float larger = 0;
  for (int k = 0; k < total / kPoints; ++k) {
    const auto random = [&](uint32_t what, uint32_t i) {
      return unitFloat(hashCombine(static_cast<uint32_t>(k), what, i));
    };
    const uint32_t patch = static_cast<uint32_t>(k) % prim.patchCount();
    const float size = k % 4 == 0 ? 1.0f : k % 4 == 1 ? 0.5f : k % 4 == 2 ? 0.1f : 0.01f;
    UvRect r;
    r.u0 = (1 - size) * random(0, 0);
    r.u1 = r.u0 + size * random(1, 0);
    r.v0 = (1 - size) * random(2, 0);
    r.v1 = r.v0 + size * random(3, 0);
    if (k % 8 == 0) r = {};
    std::vector<float> u = {r.u0, r.u1, r.u0, r.u1}, v = {r.v0, r.v0, r.v1, r.v1};
    for (uint32_t i = 0; i < kPoints; ++i) {
      u.push_back(lerp(r.u0, r.u1, random(4, i)));
      v.push_back(lerp(r.v0, r.v1, random(5, i)));
    }
    const Bound3 b = prim.bound(patch, r);
    Bound3 box;
    for (const Sample& s : samplesAt(prim, patch, u, v)) {
      box.extend(s.p);
      for (int axis = 0; axis < 3; ++axis) outside += !(s.p[axis] >= b.lo[axis] && s.p[axis] <= b.hi[axis]);
    }
    larger += maxComponent(b.size() - box.size()) / (maxComponent(box.size()) + 1e-3f * maxComponent(whole.size())) *
              kPoints / static_cast<float>(total);
  }
  EXPECT_EQ(outside, 0);
  EXPECT_LT(larger, slack);
}

/// A lattice with both ends: everything is finite, and no normal is zero.
inline void expectSoundEverywhere(const Prim& prim) {
  std::vector<float> u, v;
  for (int j = 0; j <= 8; ++j)
    for (int i = 0; i <= 8; ++i) {
      u.push_back(i / 8.0f);
      v.push_back(j / 8.0f);
    }
  for (uint32_t patch = 0; patch < prim.patchCount(); ++patch) {
    const Bound3 bound = prim.bound(patch, {});
    EXPECT_TRUE(isFinite(bound.lo) && isFinite(bound.hi));
    for (const Sample& s : samplesAt(prim, patch, u, v)) {
      EXPECT_TRUE(isFinite(s.p) && isFinite(s.du) && isFinite(s.dv) && isFinite(s.n));
      EXPECT_GT(glm::length(s.n), 0);
    }
  }
}

inline Param floats(std::string name, Storage storage, ValueType type, std::vector<float> values, int arrayLength = 1) {
  Param p;
  p.name = std::move(name);
  p.storage = storage;
  p.type = type;
  p.arrayLength = arrayLength;
  p.floats = std::move(values);
  return p;
}
inline Param positions(std::vector<float> values) {
  return floats("P", Storage::Vertex, ValueType::Point, std::move(values));
}

/// The sentence of the PrimError that `make` throws, or "" if it throws none.
template <class Make>
std::string errorOf(const Make& make) {
  try {
    make();
  } catch (const PrimError& error) {
    return error.what();
  }
  return "";
}

}  // namespace tomales::test

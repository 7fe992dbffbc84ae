// How far a pixel's coverage is from the truth with each kind of sample pattern: edges, blurred by motion and
// by defocus. Prints root mean squares over pixels that an edge crosses; docs/measured/coverage.md has the table.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numeric>

#include "reyes/base/rng.h"
#include "reyes/hide.h"

namespace {

using namespace tomales;

struct Sample {
  float x, y, time;
  vec2 lens;
};
using Pixel = std::vector<Sample>;
using Pattern = std::function<Pixel(int root, uint32_t pixel)>;  ///< root^2 samples.

vec2 onDisk(float u, float v) {
  const float r = std::sqrt(u), angle = 2 * kPi * v;
  return {r * std::cos(angle), r * std::sin(angle)};
}

float number(uint32_t pixel, int sample, uint32_t dimension) {
  return unitFloat(hashCombine(pixel, static_cast<uint32_t>(sample), dimension));
}

Pixel independent(int root, uint32_t pixel) {
  Pixel out;
  for (int s = 0; s < root * root; ++s)
    out.push_back({number(pixel, s, 0), number(pixel, s, 1), number(pixel, s, 2),
                   onDisk(number(pixel, s, 3), number(pixel, s, 4))});
  return out;
}

/// Strata of the plane, of time and of the lens, joined at random.
Pixel jittered(int root, uint32_t pixel) {
  const int n = root * root;
  const std::vector<int> times = permutation(n, hash32(pixel ^ 1U)), lenses = permutation(n, hash32(pixel ^ 2U));
  const auto in = [](int stratum, float inside, int strata) {
    return (static_cast<float>(stratum) + inside) / static_cast<float>(strata);
  };
  Pixel out;
  for (int s = 0; s < n; ++s) {
    const int lens = lenses[static_cast<size_t>(s)];
    out.push_back({in(s % root, number(pixel, s, 0), root), in(s / root, number(pixel, s, 1), root),
                   in(times[static_cast<size_t>(s)], number(pixel, s, 2), n),
                   onDisk(in(lens % root, number(pixel, s, 3), root), in(lens / root, number(pixel, s, 4), root))});
  }
  return out;
}

/// The generator matrices of Joe and Kuo (2008), the first five dimensions.
uint32_t sobol(uint32_t index, int dimension) {
  struct Polynomial {
    uint32_t degree, inner, first[3];
  };
  constexpr Polynomial kPolynomials[5] = {
      {0, 0, {}}, {1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}, {3, 2, {1, 1, 1}}};
  const Polynomial& p = kPolynomials[dimension];
  uint32_t v[32], out = 0;
  for (uint32_t b = 0; b < 32; ++b) {
    if (p.degree == 0)
      v[b] = 1U << (31 - b);
    else if (b < p.degree)
      v[b] = p.first[b] << (31 - b);
    else {
      v[b] = v[b - p.degree] ^ (v[b - p.degree] >> p.degree);
      for (uint32_t k = 1; k < p.degree; ++k)
        if ((p.inner >> (p.degree - 1 - k)) & 1U) v[b] ^= v[b - k];
    }
    if ((index >> b) & 1U) out ^= v[b];
  }
  return out;
}

/// Owen's scrambling: each bit is flipped by chance that depends on those above it.
float owen(uint32_t bits, uint32_t name) {
  uint32_t out = 0;
  for (int b = 31; b >= 8; --b) {
    const uint32_t above = b == 31 ? 0 : bits >> (b + 1);
    const uint32_t flip = hashCombine(name, static_cast<uint32_t>(b), above) & 1U;
    out |= (((bits >> b) & 1U) ^ flip) << b;
  }
  return std::min(static_cast<float>(out) * 0x1p-32f, 0x1.fffffep-1f);
}

Pixel owenSobol(int root, uint32_t pixel) {
  Pixel out;
  for (int s = 0; s < root * root; ++s) {
    float u[5];
    for (int d = 0; d < 5; ++d)
      u[d] = owen(sobol(static_cast<uint32_t>(s), d), hashCombine(pixel, static_cast<uint32_t>(d)));
    out.push_back({u[0], u[1], u[2], onDisk(u[3], u[4])});
  }
  return out;
}

Pixel ours(int root, uint32_t pixel) {
  static std::vector<std::pair<int, SamplePattern>> made;
  auto it = std::find_if(made.begin(), made.end(), [&](const auto& m) { return m.first == root; });
  if (it == made.end()) it = made.insert(made.end(), {root, SamplePattern(root, root, true, 5)});
  const SamplePattern& p = it->second;
  const int which = static_cast<int>(pixel % 256);
  Pixel out;
  for (int s = 0; s < p.count(); ++s)
    out.push_back({p.x(which)[s], p.y(which)[s], p.time(which)[s], {p.lensX(which)[s], p.lensY(which)[s]}});
  return out;
}

/// Our places in the pixel, with the times and lens points of the Owen-scrambled sample in the same cell.
/// Powers of two only: others leave cells empty.
Pixel joined(int root, uint32_t pixel) {
  Pixel out = ours(root, pixel);
  const Pixel net = owenSobol(root, hash32(pixel % 256 + 99));
  const auto cell = [&](const Sample& s) {
    return static_cast<int>(s.x * static_cast<float>(root)) + root * static_cast<int>(s.y * static_cast<float>(root));
  };
  for (Sample& s : out) {
    const auto same = std::find_if(net.begin(), net.end(), [&](const Sample& o) { return cell(o) == cell(s); });
    if (same != net.end()) {
      s.time = same->time;
      s.lens = same->lens;
    }
  }
  return out;
}

/// Is the sample behind an edge? `name` says which edge.
using Edge = std::function<bool(const Sample&, uint32_t name)>;

vec2 direction(uint32_t name) {
  const float angle = 2 * kPi * unitFloat(hash32(name ^ 11U));
  return {std::cos(angle), std::sin(angle)};
}

Edge halfPlane(float motion_px, float defocus_px) {
  return [=](const Sample& s, uint32_t name) {
    const vec2 n = direction(name), move = motion_px * direction(name ^ 77U);
    const vec2 p = vec2(s.x, s.y) - 0.5f + move * (s.time - 0.5f) + defocus_px * s.lens;
    const float reach = 0.5f + 0.5f * std::abs(dot(n, move)) + 0.5f * defocus_px;
    return dot(n, p) < reach * (2 * unitFloat(hash32(name ^ 13U)) - 1);
  };
}

Edge disk(float motion_px, float defocus_px) {
  return [=](const Sample& s, uint32_t name) {
    const vec2 move = motion_px * direction(name ^ 77U), centre = 2.0f * direction(name);
    const vec2 p = vec2(s.x, s.y) - 0.5f - centre + move * (s.time - 0.5f) + defocus_px * s.lens;
    return dot(p, p) < 4;
  };
}

double rms(const Pattern& pattern, const Edge& edge, int root, const std::vector<double>& truth) {
  double squares = 0;
  int crossed = 0;
  for (uint32_t pixel = 0; pixel < truth.size(); ++pixel) {
    const double area = truth[pixel];
    if (area <= 0.001 || area >= 0.999) continue;
    int in = 0;
    for (const Sample& s : pattern(root, hash32(pixel))) in += edge(s, pixel);
    const double error = in / static_cast<double>(root * root) - area;
    squares += error * error;
    ++crossed;
  }
  return std::sqrt(squares / crossed);
}

}  // namespace

int main() {
  const std::vector<std::pair<const char*, Pattern>> patterns = {{"independent", independent},
                                                                 {"jittered", jittered},
                                                                 {"Owen-Sobol", owenSobol},
                                                                 {"ours", ours},
                                                                 {"joined", joined}};
  const std::vector<std::pair<const char*, Edge>> edges = {
      {"half plane", halfPlane(0, 0)},        {"disk", disk(0, 0)},
      {"moving 4 px", halfPlane(4, 0)},       {"disk moving 8 px", disk(8, 0)},
      {"defocused 2 px", halfPlane(0, 2)},    {"disk defocused 3 px", disk(0, 3)},
      {"moving, defocused", halfPlane(4, 2)}, {"disk, both", disk(6, 2)}};
  fmt::print("| edge | samples |");
  for (const auto& [name, p] : patterns) fmt::print(" {} |", name);
  fmt::print("\n|---|---|{}\n", std::string(5 * patterns.size(), '-'));
  for (const auto& [edgeName, edge] : edges) {
    std::vector<double> truth;
    for (uint32_t pixel = 0; pixel < 1000; ++pixel) {
      const Pixel dense = owenSobol(64, hash32(pixel + 5000));
      truth.push_back(
          static_cast<double>(std::count_if(dense.begin(), dense.end(),
                                            [&, &covers = edge](const Sample& s) { return covers(s, pixel); })) /
          static_cast<double>(dense.size()));
    }
    for (int root : {2, 3, 4, 8}) {
      fmt::print("| {} | {}x{} |", edgeName, root, root);
      for (const auto& [name, p] : patterns) fmt::print(" {:.4f} |", rms(p, edge, root, truth));
      fmt::print("\n");
    }
  }
}

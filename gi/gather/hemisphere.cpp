#include "gi/gather/hemisphere.h"

namespace tomales {
namespace {

// Returns the integral of tan(theta) over sin^2(theta) from 0 to s.
float tangentIntegral(float s) { return std::asin(std::sqrt(s)) - std::sqrt(s * (1 - s)); }

float fraction(int i, int count) { return static_cast<float>(i) / static_cast<float>(count); }

// The gradients of Ward and Heckbert 1992, over pi. Cell (j, k) spans sin^2(theta) from j/M to (j+1)/M and
// phi from 2 pi k/N to 2 pi (k+1)/N.
struct Gradients {
  explicit Gradients(const HemisphereSamples& samples)
      : s(samples), M(samples.cells.rings), N(samples.cells.sectors), sectorAngle(2 * kPi / static_cast<float>(N)) {}

  size_t cell(int j, int k) const { return static_cast<size_t>(j * N + k); }
  vec3 inPlane(float phi) const { return std::cos(phi) * s.tangent + std::sin(phi) * s.bitangent; }

  // d/da of cos(theta - a) is sin(theta): a ray weighs tan(theta) about the axis a quarter turn ahead of its
  // azimuth. The mean of tan(theta) over the cell stands for its value at the ray, which has no finite
  // variance.
  void rotation(vec3 gradient[3]) const {
    const float sectorMean = std::sin(0.5f * sectorAngle) / (0.5f * sectorAngle);
    for (int j = 0; j < M; ++j) {
      const float ringTangent = tangentIntegral(fraction(j + 1, M)) - tangentIntegral(fraction(j, M));
      for (int k = 0; k < N; ++k) {
        const vec3 axis = inPlane(sectorAngle * (static_cast<float>(k) + 0.5f) + kPi / 2);
        add(gradient, axis * (ringTangent * sectorMean / static_cast<float>(N)), s.radiance[cell(j, k)]);
      }
    }
  }

  // As the point moves, the wall between two cells sweeps over the hemisphere at a rate of one over the
  // nearer distance, and swaps the radiance of one cell for the other's. `axis`: direction of motion that
  // sweeps most, `area`: projected, per radian.
  void wall(vec3 gradient[3], size_t from, size_t to, const vec3& axis, float area) const {
    const float distance = std::min(s.distances[from], s.distances[to]);
    if (distance < kInfinity)
      add(gradient, axis * (area / (kPi * std::max(distance, 1e-9f))), s.radiance[to] - s.radiance[from]);
  }

  void translation(vec3 gradient[3]) const {
    for (int j = 0; j < M; ++j) {
      const float sin2 = fraction(j, M), sinInner = std::sqrt(sin2), sinOuter = std::sqrt(fraction(j + 1, M));
      for (int k = 0; k < N; ++k) {
        const float phi = sectorAngle * static_cast<float>(k);
        if (j > 0)
          wall(gradient, cell(j - 1, k), cell(j, k), inPlane(phi + 0.5f * sectorAngle),
               sectorAngle * sinInner * (1 - sin2));
        wall(gradient, cell(j, (k + N - 1) % N), cell(j, k), inPlane(phi + kPi / 2), sinOuter - sinInner);
      }
    }
  }

  static void add(vec3 gradient[3], const vec3& axis, const vec3& radiance) {
    for (int c = 0; c < 3; ++c) gradient[c] += axis * radiance[c];
  }

  const HemisphereSamples& s;
  const int M, N;
  const float sectorAngle;
};

}  // namespace

namespace {

// Estimates the standard error within strata: from the differences of the rays of a cell, or where it has but one, from
// those of neighbours along the ring.
float noiseOf(const HemisphereSamples& s) {
  const size_t N = static_cast<size_t>(s.cells.sectors), count = s.radiance.size();
  float squares = 0;
  for (size_t i = 0; i < count; ++i) {
    const bool known = !s.spread.empty() && s.spread[i].known();
    size_t next = (i + 1) % N == 0 ? i + 1 - N : i + 1;
    if (!known && !s.spread.empty() && s.spread[next].known()) next = i % N == 0 ? i + N - 1 : i - 1;
    const float step = luminance(s.radiance[i]) - luminance(s.radiance[next]);
    squares += known ? s.spread[i].variance() : 0.5f * step * step;
  }
  return std::sqrt(squares) / static_cast<float>(count);
}

}  // namespace

HemisphereCells hemisphereCells(int samples) {
  const int rings = std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<float>(samples) / kPi))));
  return {rings, std::max(1, static_cast<int>(std::lround(static_cast<float>(samples) / static_cast<float>(rings))))};
}

vec3 hemisphereDirection(const HemisphereCells& cells, int ring, int sector, vec2 xi) {
  const float sin2 = std::min(1.0f, (static_cast<float>(ring) + xi.x) / static_cast<float>(cells.rings));
  const float phi = 2 * kPi * (static_cast<float>(sector) + xi.y) / static_cast<float>(cells.sectors);
  const float sine = std::sqrt(sin2);
  return {sine * std::cos(phi), sine * std::sin(phi), std::sqrt(1 - sin2)};
}

int cellOf(const HemisphereCells& cells, const vec3& direction) {
  const float sin2 = direction.x * direction.x + direction.y * direction.y, phi = std::atan2(direction.y, direction.x);
  const float turn = phi / (2 * kPi) + (phi < 0 ? 1.0f : 0.0f);
  const auto index = [](float part, int count) {
    return std::clamp(static_cast<int>(part * static_cast<float>(count)), 0, count - 1);
  };
  return index(sin2, cells.rings) * cells.sectors + index(turn, cells.sectors);
}

IrradianceRecord summarize(const HemisphereSamples& s) {
  IrradianceRecord record{};
  record.normal = s.normal;
  record.closest = kInfinity;
  float inverseDistances = 0;
  for (size_t i = 0; i < s.directions.size(); ++i) {
    record.light.E += s.radiance[i];
    for (int c = 0; c < 3; ++c) record.dominant[c] += s.directions[i] * s.radiance[i][c];
    record.closest = std::min(record.closest, s.distances[i]);
    inverseDistances += 1 / std::max(s.distances[i], 1e-9f);
  }
  const float count = static_cast<float>(s.directions.size());
  record.light.E /= count;
  record.noise = noiseOf(s);
  record.harmonicMean = inverseDistances > 0 ? count / inverseDistances : kInfinity;
  for (vec3& d : record.dominant) d = normalizeOr(d, s.normal);
  const Gradients gradients(s);
  gradients.rotation(record.light.rotationGradient);
  gradients.translation(record.light.translationGradient);
  return record;
}

}  // namespace tomales

#include "gi/gather/hessian.h"

namespace tomales {
namespace {

constexpr double kFar = 1e3;  ///< A ray that misses counts as a hit at this many times the farthest distance.

using dvec3 = glm::dvec3;

/// Integrals over a segment r(t) = r1 + t d, t in [0, 1], that appear in the derivatives of its term (Mesh::edge).
struct EdgeIntegrals {
  dvec3 r4;           ///< Integral of r / |r|^4.
  double i4;          ///< Integral of 1 / |r|^4.
  double hh, hd, dd;  ///< Integrals of r r^T / |r|^6, in the axes foot and along.
  dvec3 foot, along;
};

/// h is the length of the perpendicular from the origin to the line, and phi the angle from its foot, so that |r| = h /
/// cos(phi) and dt = h / (|d| cos^2(phi)) dphi. Returns false where the segment points at the origin and has no term.
bool integrate(const dvec3& r1, const dvec3& d, EdgeIntegrals& out) {
  const double dd = dot(d, d), length = std::sqrt(dd);
  if (!(dd > 0)) return false;
  const dvec3 along = d / length;
  const double s1 = dot(r1, along), s2 = s1 + length;
  const dvec3 foot = r1 - s1 * along;
  const double h2 = dot(foot, foot);
  if (!(h2 > 1e-12 * std::max(s1 * s1, s2 * s2))) return false;
  const double h = std::sqrt(h2), l1 = std::sqrt(h2 + s1 * s1), l2 = std::sqrt(h2 + s2 * s2);
  const double c1 = h / l1, c2 = h / l2, t1 = s1 / l1, t2 = s2 / l2;  // cosines and sines of the angles to both ends
  const double angle = std::atan2(h * length, h2 + s1 * s2);
  const double sc = t2 * c2 - t1 * c1, ss = t2 * t2 - t1 * t1;
  const double cc = 0.5 * (angle + sc);  // integral of cos^2
  const double cccs = t2 * c2 * c2 * c2 - t1 * c1 * c1 * c1;
  const double cccc = 0.25 * cccs + 0.75 * cc;                        // integral of cos^4
  const double c3s = 0.25 * (c1 * c1 * c1 * c1 - c2 * c2 * c2 * c2);  // integral of cos^3 sin
  const double over = 1 / (length * h);
  out.foot = foot / h;
  out.along = along;
  out.r4 = over / h * (cc * out.foot + 0.5 * ss * along);
  out.i4 = over / h2 * cc;
  out.hh = over / h2 * cccc;
  out.hd = over / h2 * c3s;
  out.dd = over / h2 * (cc - cccc);
  return true;
}

class Mesh {
 public:
  explicit Mesh(const HemisphereSamples& samples)
      : s_(samples),
        M_(samples.cells.rings),
        N_(samples.cells.sectors),
        n_(samples.normal),
        radiance_(samples.radiance.begin(), samples.radiance.end()) {
    axes_[0] = samples.tangent;
    axes_[1] = samples.bitangent;
    double farthest = 0;
    for (const float d : s_.distances)
      if (d < kInfinity) farthest = std::max(farthest, static_cast<double>(d));
    const double missed = farthest > 0 ? kFar * farthest : 1;
    for (size_t i = 0; i < s_.distances.size(); ++i) {
      const float d = s_.distances[i];
      reach_.push_back(d < kInfinity ? std::max(static_cast<double>(d), 1e-9 * missed) : missed);
      points_.push_back(reach_.back() * dvec3(s_.directions[i]));
    }
    addHorizon();
  }

  IrradianceCurvature sum() {
    if (N_ < 3) return {};
    const vec3 middle = meanOfInnermost();
    for (int j = 0; j <= M_; ++j)
      for (int k = 0; k < N_; ++k) {
        const size_t here = cell(j, k);
        edge(here, cell(j, k + 1), j == 0 ? middle : inner(j - 1, k), j == M_ ? vec3(0) : outer(j, k));
        if (j == M_) continue;
        edge(here, cell(j + 1, k), inner(j, k), outer(j, k - 1));
        edge(here, cell(j + 1, k + 1), outer(j, k), inner(j, k));
      }
    return out_;
  }

 private:
  size_t cell(int j, int k) const { return static_cast<size_t>(j * N_ + (k + N_) % N_); }
  /// Repeats the last ring of rays, lowered to the tangent plane. Without it the mesh has a border, and the noise of
  /// the lowest rays would not fall with their number.
  void addHorizon() {
    for (int k = 0; k < N_; ++k) {
      const size_t low = cell(M_ - 1, k);
      const dvec3 flat = points_[low] - dot(points_[low], n_) * n_;
      reach_.push_back(reach_[low]);
      radiance_.push_back(radiance_[low]);
      points_.push_back(flat * (reach_[low] / std::max(glm::length(flat), 1e-9 * reach_[low])));
    }
  }
  vec3 meanOfInnermost() const {
    vec3 sum(0);
    for (int k = 0; k < N_; ++k) sum += radiance_[cell(0, k)];
    return sum / static_cast<float>(N_);
  }
  const vec3& farthest(size_t a, size_t b, size_t c) const {
    const size_t far = reach_[a] >= reach_[b] ? (reach_[a] >= reach_[c] ? a : c) : (reach_[b] >= reach_[c] ? b : c);
    return radiance_[far];
  }
  // A quadrilateral of cells is cut from (j, k) to (j + 1, k + 1).
  const vec3& inner(int j, int k) const { return farthest(cell(j, k), cell(j + 1, k), cell(j + 1, k + 1)); }
  const vec3& outer(int j, int k) const { return farthest(cell(j, k), cell(j + 1, k + 1), cell(j, k + 1)); }

  /// The term of an edge in E/pi is n . (r1 x r2) / (2 pi) times the integral of 1 / |r|^2 (Lambert's formula), for the
  /// radiance on its left less that on its right. As the point moves by x, every r becomes r - x.
  void edge(size_t from, size_t to, const vec3& left, const vec3& right) {
    const vec3 step = left - right;
    if (step == vec3(0)) return;
    const dvec3 &r1 = points_[from], d = points_[to] - r1;
    EdgeIntegrals i;
    if (!integrate(r1, d, i)) return;
    const double area = dot(n_, cross(r1, d));
    const dvec3 nd = cross(n_, d);  // n . (d x a) = a . (n x d)
    double turn[2], slope[2];
    for (int a = 0; a < 2; ++a) {
      turn[a] = dot(nd, axes_[a]);
      slope[a] = 2 * dot(i.r4, axes_[a]);
    }
    const auto second = [&](int a, int b) {
      const double fa = dot(i.foot, axes_[a]), fb = dot(i.foot, axes_[b]), la = dot(i.along, axes_[a]),
                   lb = dot(i.along, axes_[b]);
      const double rr = fa * fb * i.hh + (fa * lb + la * fb) * i.hd + la * lb * i.dd;
      return turn[a] * slope[b] + turn[b] * slope[a] + area * (8 * rr - (a == b ? 2 * i.i4 : 0.0));
    };
    constexpr double kScale = 1 / (2 * static_cast<double>(kPi));
    out_.xx += static_cast<float>(kScale * second(0, 0)) * step;
    out_.xy += static_cast<float>(kScale * second(0, 1)) * step;
    out_.yy += static_cast<float>(kScale * second(1, 1)) * step;
  }

  const HemisphereSamples& s_;
  const int M_, N_;
  const dvec3 n_;
  dvec3 axes_[2];
  std::vector<vec3> radiance_;
  std::vector<double> reach_;
  std::vector<dvec3> points_;
  IrradianceCurvature out_{};
};

}  // namespace

IrradianceCurvature curvatureOf(const HemisphereSamples& samples) { return Mesh(samples).sum(); }

namespace {

/// Magnitudes of the eigenvalues of the Hessian of the luminance.
vec2 bendsOf(const IrradianceCurvature& h) {
  const float xx = luminance(h.xx), xy = luminance(h.xy), yy = luminance(h.yy);
  const float mean = 0.5f * (xx + yy), half = std::sqrt(0.25f * (xx - yy) * (xx - yy) + xy * xy);
  return {std::abs(mean + half), std::abs(mean - half)};
}

}  // namespace

float hessianRadius(const IrradianceCurvature& h, float luminanceOfE, float pixelSize, float tolerance) {
  const vec2 bends = bendsOf(h);
  const float bend = bends.x + bends.y;
  const float light = std::max(luminanceOfE, 0.0f);  // an estimate may be negative
  // The integral of |x^T H x| / 2 over a disk of radius R is at most (|l1| + |l2|) pi R^4 / 8.
  return bend > 0 ? std::pow(8 * tolerance * light * pixelSize * pixelSize / (kPi * bend), 0.25f) : kInfinity;
}

float variationRadius(const IrradianceCurvature& h, float variation) {
  const vec2 bends = bendsOf(h);
  const float bend = std::max(bends.x, bends.y);
  return bend > 0 ? std::sqrt(2 * variation / bend) : kInfinity;
}

}  // namespace tomales

#include "reyes/prim/blobby_ground.h"

namespace tomales {
namespace {

constexpr double kLeastHeight = 1e-6;

/// Returns a bump and its derivative: the polynomial of least degree that is 0 with two derivatives at 0 and at 2, and
/// 1 at 1.
glm::dvec2 bump(double r) {
  if (r <= 0 || r >= 2) return {0, 0};
  return {(((6 - r) * r - 12) * r + 8) * r * r * r, (((-6 * r + 30) * r - 48) * r + 24) * r * r};
}

glm::dvec2 ease(double r) {
  if (r <= 0 || r >= 1) return {r <= 0 ? 0.0 : 1.0, 0};
  return {r * r * (3 - 2 * r), 6 * r * (1 - r)};
}

/// Quadratic B-spline: smooth, and within the values that it blends.
struct SplineWeights {
  double value[3], slope[3];
  explicit SplineWeights(double t)
      : value{0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)},
        slope{t - 0.5, -2 * t, t + 0.5} {}
};

}  // namespace

FieldPoint Repulsion::at(double z) const {
  if (!(z < height)) return {};
  const double h = std::max(z, kLeastHeight);
  const glm::dvec2 b = bump(h / bulgeHeight), e = ease(h / height);
  const double force = bulge * b.x - sharpness / h, rest = 1 - e.x;
  const double slope = (bulge * b.y / bulgeHeight + sharpness / (h * h)) * rest - force * e.y / height;
  return {force * rest, {slope, 0, 0}};
}

FieldRange Repulsion::over(double lo, double hi) const {
  FieldRange out{HUGE_VAL, -HUGE_VAL};
  const auto add = [&out](const FieldRange& r) { out = {std::min(out.lo, r.lo), std::max(out.hi, r.hi)}; };
  if (!(hi < height)) add({0, 0});
  if (!(lo < height)) return out;
  constexpr int kParts = 12;
  const double first = std::max(lo, kLeastHeight), last = std::max(first, std::min(hi, height));
  for (int k = 0; k < kParts; ++k) {
    const double a = first * std::pow(last / first, static_cast<double>(k) / kParts),
                 b = first * std::pow(last / first, (k + 1.0) / kParts);
    const double r = a / bulgeHeight, s = b / bulgeHeight, atA = bump(r).x, atB = bump(s).x;
    const FieldRange hump{std::min(atA, atB), r <= 1 && s >= 1 ? 1.0 : std::max(atA, atB)};
    const FieldRange force = sum(product({bulge, bulge}, hump), product({-sharpness, -sharpness}, {1 / b, 1 / a}));
    add(product(force, {1 - ease(b / height).x, 1 - ease(a / height).x}));
  }
  return out;
}

BlobGround::BlobGround(GroundPicture picture, const Repulsion& repulsion)
    : repulsion_(repulsion), cameraFromObject_(picture.cameraFromObject), texelFromObject_(picture.texelFromObject) {
  levels_.push_back({picture.width, picture.height, picture.depth, std::move(picture.depth)});
  while (levels_.back().columns > 1 || levels_.back().rows > 1) {
    const Level& fine = levels_.back();
    Level coarse{(fine.columns + 1) / 2, (fine.rows + 1) / 2, {}, {}};
    for (int y = 0; y < coarse.rows; ++y)
      for (int x = 0; x < coarse.columns; ++x) {
        float least = INFINITY, greatest = -INFINITY;
        for (int j = 2 * y; j < std::min(2 * y + 2, fine.rows); ++j)
          for (int i = 2 * x; i < std::min(2 * x + 2, fine.columns); ++i) {
            const auto at = static_cast<size_t>(j) * static_cast<size_t>(fine.columns) + static_cast<size_t>(i);
            least = std::min(least, fine.least[at]);
            greatest = std::max(greatest, fine.greatest[at]);
          }
        coarse.least.push_back(least);
        coarse.greatest.push_back(greatest);
      }
    levels_.push_back(std::move(coarse));
  }
}

FieldPoint BlobGround::at(const dvec3& p) const {
  const Level& map = levels_.front();
  const glm::dvec4 h = texelFromObject_ * glm::dvec4(p, 1);
  const double x = h.x / h.w, y = h.y / h.w;
  if (!(h.w > 0 && x >= 0 && y >= 0 && x < map.columns && y < map.rows)) return {};
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const SplineWeights across(x - column - 0.5), down(y - row - 0.5);
  double depth = 0, byX = 0, byY = 0;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const int texelX = std::clamp(column + i - 1, 0, map.columns - 1),
                texelY = std::clamp(row + j - 1, 0, map.rows - 1);
      const double d =
          map.least[static_cast<size_t>(texelY) * static_cast<size_t>(map.columns) + static_cast<size_t>(texelX)];
      depth += across.value[i] * down.value[j] * d;
      byX += across.slope[i] * down.value[j] * d;
      byY += across.value[i] * down.slope[j] * d;
    }
  if (!std::isfinite(depth)) return {};
  const auto rowOf = [](const glm::dmat4& m, int k) { return dvec3(m[0][k], m[1][k], m[2][k]); };
  const FieldPoint out = repulsion_.at(depth - (cameraFromObject_ * glm::dvec4(p, 1)).z);
  const dvec3 w = rowOf(texelFromObject_, 3);
  const dvec3 depthGradient =
      (byX * (rowOf(texelFromObject_, 0) - x * w) + byY * (rowOf(texelFromObject_, 1) - y * w)) / h.w;
  return {out.value, out.gradient.x * (depthGradient - rowOf(cameraFromObject_, 2))};
}

double BlobGround::feature() const {
  const dvec3 up(cameraFromObject_[0].z, cameraFromObject_[1].z, cameraFromObject_[2].z);
  const bool bulges = repulsion_.bulge != 0 && repulsion_.bulgeHeight > 0;
  return std::min(repulsion_.height, bulges ? repulsion_.bulgeHeight : HUGE_VAL) / glm::length(up);
}

FieldRange BlobGround::over(const Box& box) const {
  const Level& map = levels_.front();
  double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL, near = HUGE_VAL, far = -HUGE_VAL;
  bool behind = false;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec4 corner(k & 1 ? box.hi.x : box.lo.x, k & 2 ? box.hi.y : box.lo.y, k & 4 ? box.hi.z : box.lo.z, 1);
    const glm::dvec4 h = texelFromObject_ * corner;
    const double z = (cameraFromObject_ * corner).z;
    near = std::min(near, z);
    far = std::max(far, z);
    behind = behind || !(h.w > 0);
    x0 = std::min(x0, h.x / h.w);
    x1 = std::max(x1, h.x / h.w);
    y0 = std::min(y0, h.y / h.w);
    y1 = std::max(y1, h.y / h.w);
  }
  if (behind) {
    x0 = y0 = 0;
    x1 = map.columns;
    y1 = map.rows;
  }
  if (x1 < 0 || y1 < 0 || x0 >= map.columns || y0 >= map.rows) return {0, 0};
  const bool inside = x0 >= 0 && y0 >= 0 && x1 < map.columns && y1 < map.rows;
  const FieldRange depths = depthsOver(x0, x1, y0, y1);
  FieldRange out = depths.lo < HUGE_VAL ? repulsion_.over(depths.lo - far, depths.hi - near) : FieldRange{0, 0};
  if (!inside || !(depths.hi < HUGE_VAL)) out = {std::min(0.0, out.lo), std::max(0.0, out.hi)};
  return out;
}

/// Range of all texels that points in the rectangle may blend.
FieldRange BlobGround::depthsOver(double x0, double x1, double y0, double y1) const {
  const Level& map = levels_.front();
  const auto texel = [](double x, int most) { return static_cast<int>(std::clamp(std::floor(x), 0.0, most - 1.0)); };
  int a = std::max(0, texel(x0, map.columns) - 1), b = std::min(map.columns - 1, texel(x1, map.columns) + 1);
  int c = std::max(0, texel(y0, map.rows) - 1), d = std::min(map.rows - 1, texel(y1, map.rows) + 1);
  size_t level = 0;
  for (; level + 1 < levels_.size() && (b - a > 3 || d - c > 3); ++level) {
    a /= 2;
    b /= 2;
    c /= 2;
    d /= 2;
  }
  const Level& blocks = levels_[level];
  FieldRange out{HUGE_VAL, -HUGE_VAL};
  for (int y = c; y <= d; ++y)
    for (int x = a; x <= b; ++x) {
      const auto at = static_cast<size_t>(y) * static_cast<size_t>(blocks.columns) + static_cast<size_t>(x);
      out = {std::min(out.lo, double{blocks.least[at]}), std::max(out.hi, double{blocks.greatest[at]})};
    }
  return out;
}

}  // namespace tomales

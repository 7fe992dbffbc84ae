#include "reyes/prim/face_pieces.h"

#include <numeric>

#include "reyes/prim/planar.h"

namespace tomales {
namespace {

bool allTurnsAtLeast(const std::vector<Point2>& p, double least) {
  for (size_t i = 0; i < p.size(); ++i)
    if (!(turn(p[i], p[(i + 1) % p.size()], p[(i + 2) % p.size()]) >= least)) return false;
  return true;
}

/// A polygon that turns one way only may still go around several times, like a pentagram.
bool goesAroundOnce(const std::vector<Point2>& p) {
  double angle = 0;
  for (size_t i = 0; i < p.size(); ++i) {
    const Point2 a = p[(i + 1) % p.size()] - p[i], b = p[(i + 2) % p.size()] - p[(i + 1) % p.size()];
    angle += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
  }
  return angle < 3 * M_PI;
}

/// Points by place, about one a cell, so that a small triangle meets few of them.
class PointGrid {
 public:
  explicit PointGrid(const std::vector<Point2>& p) : p_(p), lo_(p.at(0)) {
    Point2 hi = lo_;
    for (const Point2& q : p) lo_ = glm::min(lo_, q), hi = glm::max(hi, q);
    side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(p.size()))), 1, 1024);
    const Point2 size = hi - lo_;
    scale_ = {size.x > 0 ? side_ / size.x : 0, size.y > 0 ? side_ / size.y : 0};
    cells_.resize(static_cast<size_t>(side_) * static_cast<size_t>(side_));
    for (size_t i = 0; i < p.size(); ++i) cellOf(p[i]).push_back(static_cast<int>(i));
  }

  void remove(int i) { std::erase(cellOf(p_[static_cast<size_t>(i)]), i); }

  /// Does any point satisfy a condition that only those in the box can?
  template <class Condition>
  bool any(const Point2& lo, const Point2& hi, const Condition& condition) const {
    for (int row = index(lo, 1); row <= index(hi, 1); ++row)
      for (int column = index(lo, 0); column <= index(hi, 0); ++column)
        for (const int i : cells_[static_cast<size_t>(row * side_ + column)])
          if (condition(p_[static_cast<size_t>(i)])) return true;
    return false;
  }

 private:
  int index(const Point2& q, int axis) const {
    return std::clamp(static_cast<int>((q[axis] - lo_[axis]) * scale_[axis]), 0, side_ - 1);
  }
  std::vector<int>& cellOf(const Point2& q) {
    return cells_[static_cast<size_t>(index(q, 1) * side_ + index(q, 0))];
  }

  const std::vector<Point2>& p_;
  Point2 lo_, scale_;
  int side_;
  std::vector<std::vector<int>> cells_;
};

class EarClipper {
 public:
  explicit EarClipper(std::vector<Point2> points)
      : p_(std::move(points)), left_(p_), count_(p_.size()), before_(p_.size()), after_(p_.size()) {
    for (size_t i = 0; i < count_; ++i)
      before_[i] = static_cast<int>((i + count_ - 1) % count_), after_[i] = static_cast<int>((i + 1) % count_);
  }

  std::vector<Piece> clip() {
    while (count_ > 3) cut(findEar());
    if (area(next_) != 0) pieces_.push_back({before(next_), next_, after(next_)});
    return std::move(pieces_);
  }

 private:
  int before(int i) const { return before_[static_cast<size_t>(i)]; }
  int after(int i) const { return after_[static_cast<size_t>(i)]; }
  const Point2& at(int i) const { return p_[static_cast<size_t>(i)]; }
  double area(int i) const { return turn(at(before(i)), at(i), at(after(i))); }

  bool isEar(int i) const {
    const Point2 &a = at(before(i)), &b = at(i), &c = at(after(i));
    return !left_.any(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), [&](const Point2& p) {
      return p != a && p != b && p != c && contains(a, b, c, p);
    });
  }

  /// The first true ear after the last one cut; failing that a corner without area, failing that the biggest.
  int findEar() const {
    int i = next_;
    for (size_t k = 0; k < count_; ++k, i = after(i))
      if (area(i) > 0 && isEar(i)) return i;
    int best = next_;
    for (size_t k = 0; k < count_; ++k, i = after(i)) {
      if (area(i) == 0) return i;
      if (area(i) > area(best)) best = i;
    }
    return best;
  }

  void cut(int i) {
    if (area(i) != 0) pieces_.push_back({before(i), i, after(i)});
    left_.remove(i);
    after_[static_cast<size_t>(before(i))] = after(i);
    before_[static_cast<size_t>(after(i))] = before(i);
    next_ = after(i);
    --count_;
  }

  const std::vector<Point2> p_;
  PointGrid left_;
  size_t count_;
  std::vector<int> before_, after_;  ///< Of those that are left.
  int next_ = 0;
  std::vector<Piece> pieces_;
};

}  // namespace

std::vector<Point2> projected(const std::vector<vec3>& points, const glm::dvec3& normal) {
  const glm::dvec3 size = glm::abs(normal);
  const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  const bool mirrored = normal[axis] < 0;
  std::vector<Point2> out;
  for (const vec3& p : points) {
    const Point2 q(p[(axis + 1) % 3], p[(axis + 2) % 3]);
    out.push_back(mirrored ? Point2(q.y, q.x) : q);
  }
  return out;
}

glm::dvec3 newellNormal(const std::vector<vec3>& points) {
  glm::dvec3 normal(0);
  const glm::dvec3 origin = points.empty() ? glm::dvec3(0) : glm::dvec3(points[0]);
  for (size_t i = 0; i < points.size(); ++i)
    normal +=
        glm::cross(glm::dvec3(points[i]) - origin, glm::dvec3(points[(i + 1) % points.size()]) - origin);
  return normal;
}

glm::dvec3 normalOfWidestTriangle(const std::vector<vec3>& points) {
  glm::dvec3 farthest(0), normal(0);
  for (const vec3& p : points)
    if (const glm::dvec3 way(p - points[0]); glm::length(way) > glm::length(farthest)) farthest = way;
  for (const vec3& p : points)
    if (const glm::dvec3 n = glm::cross(farthest, glm::dvec3(p - points[0])); glm::length(n) > glm::length(normal)) normal = n;
  return normal;
}

bool isStrictlyConvex(const std::vector<vec3>& points, const glm::dvec3& normal) {
  const std::vector<Point2> p = projected(points, normal);
  return allTurnsAtLeast(p, 1e-6 * glm::length(normal)) && goesAroundOnce(p);
}

std::vector<Piece> convexPieces(const std::vector<vec3>& points, const glm::dvec3& normal) {
  const std::vector<Point2> p = projected(points, normal);
  if (!allTurnsAtLeast(p, 0) || !goesAroundOnce(p)) return EarClipper(p).clip();
  Piece whole(points.size());
  std::iota(whole.begin(), whole.end(), 0);
  return {whole};
}

}  // namespace tomales

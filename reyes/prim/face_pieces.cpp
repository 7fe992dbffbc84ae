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

class EarClipper {
 public:
  explicit EarClipper(std::vector<Point2> points) : p_(std::move(points)), left_(p_.size()) {
    std::iota(left_.begin(), left_.end(), 0);
  }

  std::vector<Piece> clip() {
    while (left_.size() > 3) cut(findEar());
    if (area(0) != 0) pieces_.push_back(left_);
    return std::move(pieces_);
  }

 private:
  int neighbour(size_t i, size_t step) const { return left_[(i + step) % left_.size()]; }
  int before(size_t i) const { return neighbour(i, left_.size() - 1); }
  int after(size_t i) const { return neighbour(i, 1); }
  double area(size_t i) const { return turn(p_[before(i)], p_[left_[i]], p_[after(i)]); }

  bool isEar(size_t i) const {
    const Point2 &a = p_[before(i)], &b = p_[left_[i]], &c = p_[after(i)];
    for (int other : left_) {
      const Point2& p = p_[other];
      if (p != a && p != b && p != c && contains(a, b, c, p)) return false;
    }
    return true;
  }

  /// The first true ear after the last one cut; failing that a corner without area, failing that the biggest.
  size_t findEar() const {
    const size_t n = left_.size();
    for (size_t k = 0; k < n; ++k)
      if (const size_t i = (next_ + k) % n; area(i) > 0 && isEar(i)) return i;
    size_t best = 0;
    for (size_t i = 0; i < n; ++i) {
      if (area(i) == 0) return i;
      if (area(i) > area(best)) best = i;
    }
    return best;
  }

  void cut(size_t i) {
    if (area(i) != 0) pieces_.push_back({before(i), left_[i], after(i)});
    left_.erase(left_.begin() + static_cast<ptrdiff_t>(i));
    next_ = i;
  }

  std::vector<Point2> p_;
  Piece left_;
  size_t next_ = 0;
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

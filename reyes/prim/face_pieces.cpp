#include "reyes/prim/face_pieces.h"

#include <numeric>
#include <optional>

namespace tomales {
namespace {

constexpr size_t kMostTries = 32, kMostTriedCorners = 10'000;

double twiceArea(const std::vector<Point2>& p) {
  double area = 0;
  for (size_t i = 1; i + 1 < p.size(); ++i) area += turn(p[0], p[i], p[i + 1]);
  return area;
}

bool allTurnsAtLeast(const std::vector<Point2>& p, double least) {
  for (size_t i = 0; i < p.size(); ++i)
    if (!(turn(p[i], p[(i + 1) % p.size()], p[(i + 2) % p.size()]) >= least)) return false;
  return true;
}

/// Tells whether the polygon goes around once. A polygon that turns one way only may go around several times, like a
/// pentagram.
bool goesAroundOnce(const std::vector<Point2>& p) {
  double angle = 0;
  for (size_t i = 0; i < p.size(); ++i) {
    const Point2 a = p[(i + 1) % p.size()] - p[i], b = p[(i + 2) % p.size()] - p[(i + 1) % p.size()];
    angle += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
  }
  return angle < 3 * M_PI;
}

/// Points in a grid with about one point in each cell, so that a small triangle tests few of them.
class PointGrid {
 public:
  PointGrid(const std::vector<Point2>& p) : p_(p), lo_(p.at(0)) {
    Point2 hi = lo_;
    for (const Point2& q : p) {
      lo_ = glm::min(lo_, q);
      hi = glm::max(hi, q);
    }
    side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(p.size()))), 1, 1024);
    const Point2 size = hi - lo_;
    scale_ = {size.x > 0 ? side_ / size.x : 0, size.y > 0 ? side_ / size.y : 0};
    cells_.resize(static_cast<size_t>(side_) * static_cast<size_t>(side_));
    for (size_t i = 0; i < p.size(); ++i) cellOf(p[i]).push_back(static_cast<int>(i));
  }

  void remove(int i) { std::erase(cellOf(p_[static_cast<size_t>(i)]), i); }

  /// Tells whether any point, given by its index, satisfies a condition that only points in the box can satisfy.
  template <class Condition>
  bool any(const Point2& lo, const Point2& hi, const Condition& condition) const {
    for (int row = index(lo, 1); row <= index(hi, 1); ++row)
      for (int column = index(lo, 0); column <= index(hi, 0); ++column)
        for (const int i : cells_[static_cast<size_t>(row * side_ + column)])
          if (condition(i)) return true;
    return false;
  }

 private:
  int index(const Point2& q, int axis) const {
    return std::clamp(static_cast<int>((q[axis] - lo_[axis]) * scale_[axis]), 0, side_ - 1);
  }
  std::vector<int>& cellOf(const Point2& q) { return cells_[static_cast<size_t>(index(q, 1) * side_ + index(q, 0))]; }

  const std::vector<Point2>& p_;
  Point2 lo_, scale_;
  int side_;
  std::vector<std::vector<int>> cells_;
};

/// Cuts off corners that are ears at all keys; if there are none, ears of the first key.
class EarClipper {
 public:
  /// The search for ears begins at position `start`.
  EarClipper(const Outlines& keys, int start)
      : p_(keys), left_(keys.begin(), keys.end()), count_(keys[0].size()), next_(start) {
    for (size_t i = 0; i < count_; ++i) {
      before_.push_back(static_cast<int>((i + count_ - 1) % count_));
      after_.push_back(static_cast<int>((i + 1) % count_));
    }
    suspects_ = before_;
    dropSpikes();
  }

  Pieces clip() {
    while (count_ > 3) cut(findEar());
    addPiece(next_);
    return std::move(out_);
  }

  /// Returns nothing as soon as there is no common ear.
  std::optional<Pieces> clipAlike() {
    while (count_ > 3) {
      cut(findEar());
      if (!out_.disjoint) return std::nullopt;
    }
    addPiece(next_);
    return std::move(out_);
  }

 private:
  int before(int i) const { return before_[static_cast<size_t>(i)]; }
  int after(int i) const { return after_[static_cast<size_t>(i)]; }
  const Point2& at(size_t key, int i) const { return p_[key][static_cast<size_t>(i)]; }
  double area(size_t key, int i) const { return turn(at(key, before(i)), at(key, i), at(key, after(i))); }
  bool hasArea(int i) const {
    for (size_t key = 0; key < p_.size(); ++key)
      if (area(key, i) != 0) return true;
    return false;
  }

  /// Tells whether the corner is a spike. Its edges lie on each other and enclose nothing.
  bool isSpike(int i) const {
    for (size_t key = 0; key < p_.size(); ++key)
      if (area(key, i) != 0 || glm::dot(at(key, before(i)) - at(key, i), at(key, after(i)) - at(key, i)) < 0)
        return false;
    return true;
  }

  /// Tells whether vertex i is in the triangle abc. Where the outline touches itself, a vertex at a corner of the
  /// triangle counts if one of its edges goes inside.
  bool isWithin(size_t key, int i, const std::array<Point2, 3>& abc) const {
    const Point2& p = at(key, i);
    for (size_t k = 0; k < 3; ++k) {
      const Point2 &from = abc[(k + 2) % 3], &to = abc[(k + 1) % 3];
      const auto goesInside = [&](const Point2& end) { return turn(p, to, end) > 0 && turn(from, p, end) > 0; };
      if (p == abc[k]) return goesInside(at(key, before(i))) || goesInside(at(key, after(i)));
    }
    return contains(abc[0], abc[1], abc[2], p);
  }

  bool isEar(size_t key, int i) const {
    if (!(area(key, i) > 0)) return false;
    const Point2 &a = at(key, before(i)), &b = at(key, i), &c = at(key, after(i));
    return !left_[key].any(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), [&](int k) {
      return k != before(i) && k != i && k != after(i) && isWithin(key, k, {a, b, c});
    });
  }

  /// Tells whether the corner is an ear at all keys. At a key where it has no area it takes nothing away.
  bool isEar(int i) const {
    for (size_t key = 0; key < p_.size(); ++key)
      if (area(key, i) != 0 && !isEar(key, i)) return false;
    return hasArea(i);
  }

  template <class Condition>
  std::optional<int> firstCorner(const Condition& condition) const {
    int i = next_;
    for (size_t k = 0; k < count_; ++k, i = after(i))
      if (condition(i)) return i;
    return {};
  }

  /// Returns the first true ear after the last one that was cut; failing that a corner without area; failing that the
  /// largest corner.
  int findEar() {
    if (out_.disjoint)
      if (const auto ear = firstCorner([&](int i) { return isEar(i); })) return *ear;
    if (p_.size() > 1) out_.disjoint = false;
    if (const auto ear = firstCorner([&](int i) { return isEar(0, i); })) return *ear;
    if (const auto straight = firstCorner([&](int i) { return !hasArea(i); })) return *straight;
    int best = next_;
    firstCorner([&](int i) {
      if (area(0, i) > area(0, best)) best = i;
      return false;
    });
    return best;
  }

  void addPiece(int i) {
    if (hasArea(i)) out_.list.push_back({before(i), i, after(i)});
  }

  void cut(int i) {
    addPiece(i);
    next_ = after(i);
    remove(i);
    dropSpikes();
  }

  void remove(int i) {
    for (PointGrid& left : left_) left.remove(i);
    after_[static_cast<size_t>(before(i))] = after(i);
    before_[static_cast<size_t>(after(i))] = before(i);
    suspects_.insert(suspects_.end(), {before(i), after(i)});
    --count_;
  }

  /// Spikes are dropped at once, because a corner at the foot of a spike looks like an ear.
  void dropSpikes() {
    while (!suspects_.empty()) {
      const int i = suspects_.back();
      suspects_.pop_back();
      if (count_ <= 3 || after(before(i)) != i || !isSpike(i)) continue;
      if (next_ == i) next_ = after(i);
      remove(i);
    }
  }

  const Outlines& p_;
  std::vector<PointGrid> left_;  ///< Indexed by key.
  size_t count_;
  std::vector<int> before_, after_;  ///< Neighbours among the corners that are left.
  std::vector<int> suspects_;        ///< Corners that may have become spikes.
  int next_;
  Pieces out_;
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
    normal += glm::cross(glm::dvec3(points[i]) - origin, glm::dvec3(points[(i + 1) % points.size()]) - origin);
  return normal;
}

glm::dvec3 normalOfWidestTriangle(const std::vector<vec3>& points) {
  glm::dvec3 farthest(0), normal(0);
  for (const vec3& p : points)
    if (const glm::dvec3 way(p - points[0]); glm::length(way) > glm::length(farthest)) farthest = way;
  for (const vec3& p : points)
    if (const glm::dvec3 n = glm::cross(farthest, glm::dvec3(p - points[0])); glm::length(n) > glm::length(normal))
      normal = n;
  return normal;
}

bool isStrictlyConvex(const Outlines& keys) {
  return std::all_of(keys.begin(), keys.end(), [](const std::vector<Point2>& p) {
    return allTurnsAtLeast(p, 1e-6 * std::abs(twiceArea(p))) && goesAroundOnce(p);
  });
}

Pieces convexPieces(const Outlines& keys) {
  const size_t n = keys[0].size();
  if (std::all_of(keys.begin(), keys.end(), [](const auto& p) { return allTurnsAtLeast(p, 0) && goesAroundOnce(p); })) {
    Piece whole(n);
    std::iota(whole.begin(), whole.end(), 0);
    return {{whole}};
  }
  // The set of common ears depends on the ears that have been cut before.
  const size_t tries = keys.size() > 1 ? std::min({n, kMostTries, kMostTriedCorners / n}) : 0;
  for (size_t start = 0; start < tries; ++start)
    if (std::optional<Pieces> pieces = EarClipper(keys, static_cast<int>(start)).clipAlike()) return *std::move(pieces);
  return EarClipper(keys, 0).clip();
}

}  // namespace tomales

// Method: D. Eberly, "Triangulation by ear clipping" (2002), section 5. A ray to the right from the rightmost vertex of
// a hole meets an edge, and near that edge there is a corner that the vertex sees.
#include "reyes/prim/hole_bridges.h"

#include <numeric>
#include <span>

namespace tomales {
namespace {

using Walk = std::vector<uint32_t>;

// Greatest number of pairs of a hole's vertex and a corner that are tried if the bridge of the first key is not clear.
constexpr size_t kMostPairs = 10'000;

/// Tells whether p lies between a and b, but on neither.
bool liesBetween(const Point2& a, const Point2& b, const Point2& p) {
  return p != a && p != b && turn(a, b, p) == 0 && glm::dot(p - a, p - b) < 0;
}

bool cross(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

class Bridger {
 public:
  Bridger(const Outlines& keys, Walk outline)
      : keys_(keys), p_(keys[0]), walk_(std::move(outline)), shared_(shared(keys[0])) {}

  /// Adds a hole that goes clockwise and begins with its rightmost vertex; `later` are the holes to be added after it.
  /// Returns false if it lies outside.
  bool add(Walk hole, std::span<const Walk> later) {
    int at = findContact(hole);
    if (at < 0) at = findCorner(p_[hole[0]]);
    if (at < 0) return false;
    if (keys_.size() > 1 && !isClear(hole, at, later)) at = findClear(hole, at, later);
    hole.insert(hole.end(), {hole[0], number(at)});
    walk_.insert(walk_.begin() + at + 1, hole.begin(), hole.end());
    return true;
  }

  bool simple() const { return simple_; }
  Walk walk() && { return std::move(walk_); }

 private:
  int size() const { return static_cast<int>(walk_.size()); }
  /// Returns the index of the corner at a position in the walk, which is cyclic.
  uint32_t number(int i) const { return walk_[static_cast<size_t>((i + size()) % size())]; }
  const Point2& corner(int i) const { return p_[number(i)]; }

  static bool isLess(const Point2& a, const Point2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }
  /// Positions that several points share, sorted.
  static std::vector<Point2> shared(std::vector<Point2> p) {
    std::sort(p.begin(), p.end(), isLess);
    std::vector<Point2> out;
    for (size_t i = 1; i < p.size(); ++i)
      if (p[i] == p[i - 1]) out.push_back(p[i]);
    return out;
  }

  /// Finds the position in the walk of a corner that the hole touches from inside, and turns the hole to begin there;
  /// -1 if there is none. Any other bridge might cross the walk where it passes between the two.
  int findContact(Walk& hole) const {
    for (size_t k = 0; k < hole.size(); ++k) {
      const Point2& m = p_[hole[k]];
      if (!std::binary_search(shared_.begin(), shared_.end(), m, isLess)) continue;
      const Point2 &before = p_[hole[(k + hole.size() - 1) % hole.size()]], &after = p_[hole[(k + 1) % hole.size()]];
      for (int at = 0; at < size(); ++at) {
        if (corner(at) != m || !sees(at, before) || !sees(at, after)) continue;
        std::rotate(hole.begin(), hole.begin() + static_cast<ptrdiff_t>(k), hole.end());
        return at;
      }
    }
    return -1;
  }

  /// Returns the position in the walk of a corner to which m can be joined; -1 if there is none.
  int findCorner(const Point2& m) const {
    double hit = kInfinity;
    int edge = -1;
    for (int i = 0; i < size(); ++i) {
      const Point2 &a = corner(i), &b = corner(i + 1);
      if (!(a.y <= m.y && m.y <= b.y && a.y < b.y)) continue;  // the inside is to the left of an edge that rises
      const double x = a.x + (m.y - a.y) / (b.y - a.y) * (b.x - a.x);
      if (x >= m.x && x < hit) {
        hit = x;
        edge = i;
      }
    }
    return edge < 0 ? -1 : nearestToRay(m, {hit, m.y}, edge);
  }

  /// Among the corners in the triangle between m, the hit and the right end of the hit edge, the one that is nearest in
  /// angle to the ray hides all others.
  int nearestToRay(const Point2& m, const Point2& hit, int edge) const {
    const int end = (corner(edge).x > corner(edge + 1).x ? edge : edge + 1) % size();
    const Point2& far = corner(end);
    int best = end;
    for (int i = 0; i < size(); ++i) {
      const Point2& p = corner(i);
      const bool between = far.y < m.y ? contains(m, far, hit, p) : contains(m, hit, far, p);
      if (between && p.x >= m.x && sees(i, m) && (best == end && !sees(end, m) ? true : before(m, p, corner(best))))
        best = i;
    }
    return best;
  }

  /// Tells whether a is nearer in angle to the ray from m to the right than b, or at the same angle nearer.
  static bool before(const Point2& m, const Point2& a, const Point2& b) {
    const Point2 x = glm::abs(a - m), y = glm::abs(b - m);
    const double slopes = x.y * y.x - y.y * x.x;
    return slopes != 0 ? slopes < 0 : x.x < y.x;
  }

  /// Tells whether m lies towards the inside from corner i. This distinguishes the copies of a corner that bridges have
  /// made.
  bool sees(int i, const Point2& m) const { return sees(p_, i, m); }
  bool sees(const std::vector<Point2>& p, int i, const Point2& m) const {
    const auto at = [&](int k) { return p[number(k)]; };
    const Point2 b = at(i);
    int before = i - 1, after = i + 1;  // passes bridges of no length
    while (at(before) == b && before > i - size()) --before;
    while (at(after) == b && after < i + size()) ++after;
    const Point2 a = at(before), c = at(after);
    const bool leftOfIn = turn(a, b, m) >= 0, leftOfOut = turn(b, c, m) >= 0;
    return turn(a, b, c) >= 0 ? leftOfIn && leftOfOut : leftOfIn || leftOfOut;
  }

  /// Tells whether the edge ab of a key touches a loop anywhere but at its own ends.
  static bool touches(const std::vector<Point2>& p, const Point2& a, const Point2& b, const Walk& loop) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const Point2 &c = p[loop[i]], &d = p[loop[(i + 1) % loop.size()]];
      if (liesBetween(a, b, c) || cross(a, b, c, d)) return true;
    }
    return false;
  }

  /// Tells whether the bridge from the hole's first vertex to a position in the walk is inside and clear of everything,
  /// at every key.
  bool isClear(const Walk& hole, int at, std::span<const Walk> later) const {
    for (const std::vector<Point2>& p : keys_) {
      const Point2 &a = p[hole[0]], &b = p[number(at)];
      if (!sees(p, at, a) || touches(p, a, b, walk_) || touches(p, a, b, hole)) return false;
      if (std::any_of(later.begin(), later.end(), [&](const Walk& loop) { return touches(p, a, b, loop); }))
        return false;
    }
    return true;
  }

  /// Returns the position of the first clear bridge, and turns the hole to begin with its vertex. If there is none, it
  /// returns `fallback` and leaves the hole.
  int findClear(Walk& hole, int fallback, std::span<const Walk> later) {
    Walk turned = hole;
    if (hole.size() * walk_.size() <= kMostPairs)
      for (size_t k = 0; k < hole.size(); ++k, std::rotate(turned.begin(), turned.begin() + 1, turned.end()))
        for (int at = 0; at < size(); ++at)
          if (isClear(turned, at, later)) {
            hole = turned;
            return at;
          }
    simple_ = false;
    return fallback;
  }

  const Outlines& keys_;
  const std::vector<Point2>& p_;  ///< Points of the first key.
  Walk walk_;
  const std::vector<Point2> shared_;
  bool simple_ = true;
};

double signedArea(const std::vector<Point2>& p, const Walk& loop) {
  double area = 0;
  for (size_t i = 1; i + 1 < loop.size(); ++i) area += turn(p[loop[0]], p[loop[i]], p[loop[i + 1]]);
  return area;
}

}  // namespace

BridgedOutline bridgeHoles(const Outlines& keys, const std::vector<int>& loopStarts) {
  const std::vector<Point2>& p = keys[0];
  std::vector<Walk> loops;
  for (size_t k = 0; k + 1 < loopStarts.size(); ++k) {
    Walk loop(static_cast<size_t>(loopStarts[k + 1] - loopStarts[k]));
    std::iota(loop.begin(), loop.end(), static_cast<uint32_t>(loopStarts[k]));
    const double area = signedArea(p, loop);
    if (k && area == 0) continue;  // takes nothing away
    if (k && area > 0) std::reverse(loop.begin(), loop.end());
    const auto lefter = [&](uint32_t a, uint32_t b) { return p[a].x < p[b].x; };
    if (k) std::rotate(loop.begin(), std::max_element(loop.begin(), loop.end(), lefter), loop.end());
    loops.push_back(std::move(loop));
  }
  // Holes are added from right to left, so that no later hole is in the way of a bridge.
  std::stable_sort(loops.begin() + 1, loops.end(), [&](const Walk& a, const Walk& b) { return p[a[0]].x > p[b[0]].x; });
  Bridger bridger(keys, loops[0]);
  BridgedOutline out;
  const std::span<const Walk> holes(loops);
  for (size_t k = 1; k < loops.size(); ++k) out.ignored += !bridger.add(loops[k], holes.subspan(k + 1));
  out.simple = bridger.simple();
  out.order = std::move(bridger).walk();
  return out;
}

}  // namespace tomales

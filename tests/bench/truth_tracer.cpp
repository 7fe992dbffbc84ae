// A path tracer that judges the renderer: it shares no line with it. Surfaces are matte or plastic, and things may
// move; every path goes on until chance ends it. It reads a scene from standard input and prints the mean of each block
// of 8 x 8 pixels and the standard error of that mean: `truth_tracer PATHS_A_PIXEL THREADS`.
//
//   size WIDTH HEIGHT
//   camera FOV EYE RIGHT UP FORWARD         the angle of the shorter side, in degrees
//   sky L
//   point X Y Z INTENSITY
//   triangle A B C ALBEDO EMITTED           EMITTED leaves by the side of (b - a) x (c - a)
//   quad A B C D ALBEDO EMITTED             a parallelogram, likewise with (d - a)
//   lamp A B C D ALBEDO EMITTED             the same, and it is sampled
//   sphere X Y Z RADIUS ALBEDO EMITTED V    moves by V over the shutter, and shines from both sides
//   gloss KS EXPONENT                       what follows shines too: KS (N.H)^EXPONENT, without a cosine
//   aim A B C D                             a fifth of all paths go on through such places; this changes noise alone
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

namespace {

struct V {
  double x = 0, y = 0, z = 0;
  V operator+(const V& o) const { return {x + o.x, y + o.y, z + o.z}; }
  V operator-(const V& o) const { return {x - o.x, y - o.y, z - o.z}; }
  V operator*(double s) const { return {x * s, y * s, z * s}; }
};
double dot(const V& a, const V& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
V cross(const V& a, const V& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
V unit(const V& a) { return a * (1 / std::sqrt(dot(a, a))); }
double at(const V& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }
std::istream& operator>>(std::istream& in, V& v) { return in >> v.x >> v.y >> v.z; }

constexpr double kFar = 1e30, kNear = 1e-7, kPi = 3.14159265358979323846;
constexpr double kMirrored = 0.3;  // the share of paths that go on by the highlight, where there is one
constexpr double kAimed = 0.2;     // more would make the other paths rare, and each of them count for much

// PCG of 32 bits (O'Neill 2014).
struct Random {
  uint64_t state;
  explicit Random(uint64_t seed) : state(seed * 0x9E3779B97F4A7C15ull + 1442695040888963407ull) {
    next();
    next();
  }
  double next() {
    const uint64_t s = state;
    state = s * 6364136223846793005ull + 1442695040888963407ull;
    const auto x = static_cast<uint32_t>(((s >> 18) ^ s) >> 27), r = static_cast<uint32_t>(s >> 59);
    return ((x >> r) | (x << ((32 - r) & 31))) * 0x1p-32;
  }
};

struct Shape {
  bool ball = false, whole = false, lamp = false;  // whole: a parallelogram, else a triangle; lamp: it is sampled
  V a, u, v;                                       // corner and edges; a ball: centre, and v is its motion
  double radius = 0, albedo = 0, emitted = 0;
  double gloss = 0, exponent = 1;
  V normal(const V& P, double time) const { return ball ? unit(P - (a + v * time)) : unit(cross(u, v)); }
  double meet(const V& O, const V& D, double time) const {
    if (ball) {
      const V c = O - (a + v * time);
      const double b = dot(c, D), q = b * b - dot(c, c) + radius * radius;
      if (q < 0) return kFar;
      const double s = std::sqrt(q);
      return -b - s > kNear ? -b - s : -b + s > kNear ? -b + s : kFar;
    }
    const V p = cross(D, v);
    const double det = dot(u, p);
    if (det == 0) return kFar;
    const V s = O - a, q = cross(s, u);
    const double x = dot(s, p) / det, y = dot(D, q) / det, t = dot(v, q) / det;
    return x < 0 || y < 0 || (whole ? x > 1 || y > 1 : x + y > 1) || t < kNear ? kFar : t;
  }
  void bound(V& lo, V& hi) const {
    const auto add = [&](const V& p, double r) {
      lo = {std::min(lo.x, p.x - r), std::min(lo.y, p.y - r), std::min(lo.z, p.z - r)};
      hi = {std::max(hi.x, p.x + r), std::max(hi.y, p.y + r), std::max(hi.z, p.z + r)};
    };
    if (ball) {
      add(a, radius);
      return add(a + v, radius);
    }
    add(a, 0);
    add(a + u, 0);
    add(a + v, 0);
    if (whole) add(a + u + v, 0);
  }
};

struct Node {
  V lo, hi;
  int begin, end, left;  // left < 0: a leaf; the right child follows
};

struct Scene {
  int width = 128, height = 128;
  double fov = 60, sky = 0, power = 0;
  V eye, right, up, forward, point;
  std::vector<Shape> shapes, lamps, aims;
  std::vector<Node> nodes;

  int build(int begin, int end) {
    Node n{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}, begin, end, -1};
    for (int i = begin; i < end; ++i) shapes[i].bound(n.lo, n.hi);
    const int me = static_cast<int>(nodes.size());
    nodes.push_back(n);
    if (end - begin <= 4) return me;
    const V size = n.hi - n.lo;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2, middle = (begin + end) / 2;
    const auto key = [&](const Shape& s) {
      V lo{kFar, kFar, kFar}, hi{-kFar, -kFar, -kFar};
      s.bound(lo, hi);
      return at(lo, axis) + at(hi, axis);
    };
    std::nth_element(shapes.begin() + begin, shapes.begin() + middle, shapes.begin() + end,
                     [&](const Shape& x, const Shape& y) { return key(x) < key(y); });
    nodes[me].left = build(begin, middle);
    const int second = build(middle, end);
    nodes[me].end = second;  // of an inner node: its second child
    return me;
  }

  double meet(const V& O, const V& D, double time, double most, const Shape*& what) const {
    const V inverse{1 / D.x, 1 / D.y, 1 / D.z};
    std::array<int, 128> stack;
    int depth = 0;
    stack[depth++] = 0;
    what = nullptr;
    while (depth > 0) {
      const Node& n = nodes[stack[--depth]];
      double near = 0, far = most;
      for (int k = 0; k < 3; ++k) {
        double x = (at(n.lo, k) - 1e-9 - at(O, k)) * at(inverse, k),
               y = (at(n.hi, k) + 1e-9 - at(O, k)) * at(inverse, k);
        if (x > y) std::swap(x, y);
        near = std::max(near, x);
        far = std::min(far, y);
      }
      if (!(near <= far)) continue;
      if (n.left >= 0) {
        stack[depth++] = n.left;
        stack[depth++] = n.end;
        continue;
      }
      for (int i = n.begin; i < n.end; ++i)
        if (const double t = shapes[i].meet(O, D, time); t < most) {
          most = t;
          what = &shapes[i];
        }
    }
    return most;
  }

  bool sees(const V& P, const V& Q, double time) const {
    const V d = Q - P;
    const double length = std::sqrt(dot(d, d));
    const Shape* any;
    meet(P, d * (1 / length), time, length * (1 - 1e-6), any);
    return !any;
  }

  // What lamps and the point light send to P and on towards -D.
  double direct(const Shape& s, const V& P, const V& N, const V& D, double time, Random& r) const {
    double sum = 0;
    const auto add = [&](const V& Q, double light) {  // light: over pi, as it would come to a surface that faces it
      const V L = unit(Q - P);
      const double cosine = dot(N, L);
      if (!(cosine > 0 && light > 0 && sees(P, Q, time))) return;
      sum += light * s.albedo * cosine;
      if (s.gloss > 0) sum += light * s.gloss * std::pow(std::max(0.0, dot(N, unit(L - D))), s.exponent);
    };
    if (power > 0) add(point, power / dot(point - P, point - P));
    for (const Shape& lamp : lamps) {
      const V Q = lamp.a + lamp.u * r.next() + lamp.v * r.next(), d = Q - P, n = cross(lamp.u, lamp.v);
      const double d2 = dot(d, d);
      add(Q, -lamp.emitted * dot(n, d) / (d2 * std::sqrt(d2) * kPi));  // n has the length of the lamp's area
    }
    return sum;
  }

  // A direction of the highlight to go on in, and how much light of there counts: H is drawn as the lobe is.
  static V mirrored(const Shape& s, const V& N, const V& D, Random& r, double& counts) {
    const double phi = 2 * kPi * r.next(), c = std::pow(1 - r.next(), 1 / (s.exponent + 1)), q = std::sqrt(1 - c * c);
    const V T = tangent(N), H = T * (q * std::cos(phi)) + cross(N, T) * (q * std::sin(phi)) + N * c;
    const double along = -dot(D, H);
    const V L = D + H * (2 * along);
    counts = along > 0 && dot(N, L) > 0 ? s.gloss * 8 * along / (s.exponent + 1) : 0;
    return L;
  }

  static V tangent(const V& N) { return unit(cross(std::abs(N.x) < 0.7 ? V{1, 0, 0} : V{0, 1, 0}, N)); }

  // A direction to go on in, and how much light of there counts.
  V onward(const V& P, const V& N, Random& r, double& counts) const {
    const bool aimed = !aims.empty() && r.next() < kAimed;
    V D;
    if (aimed) {
      const Shape& a =
          aims[std::min(aims.size() - 1, static_cast<size_t>(r.next() * static_cast<double>(aims.size())))];
      D = unit(a.a + a.u * r.next() + a.v * r.next() - P);
    } else {
      const double phi = 2 * kPi * r.next(), s2 = r.next(), s1 = std::sqrt(s2);
      const V T = tangent(N), B = cross(N, T);
      D = unit(T * (s1 * std::cos(phi)) + B * (s1 * std::sin(phi)) + N * std::sqrt(1 - s2));
    }
    const double cosine = std::max(0.0, dot(N, D)) / kPi;
    double density = aims.empty() ? cosine : (1 - kAimed) * cosine;
    for (const Shape& a : aims)
      if (const double t = a.meet(P, D, 0); t < kFar)
        density += kAimed / static_cast<double>(aims.size()) * t * t / std::abs(dot(cross(a.u, a.v), D));
    counts = cosine > 0 ? cosine / density : 0;
    return D;
  }

  double path(V O, V D, Random& r) const {
    const double time = r.next();
    double sum = 0, weight = 1;
    for (int depth = 0;; ++depth) {
      const Shape* s;
      const double t = meet(O, D, time, kFar, s);
      if (!s) return depth == 0 ? 0 : sum + weight * sky;  // the picture has no background
      const V P = O + D * t;
      V N = s->normal(P, time);
      const bool front = dot(N, D) < 0;
      if ((front || s->ball) && (depth == 0 || !s->lamp)) sum += weight * s->emitted;
      if (!front) N = N * -1;
      O = P + N * 1e-6;
      sum += weight * direct(*s, O, N, D, time, r);
      const double goesOn = depth < 3 ? 1 : s->albedo;
      weight /= goesOn;
      if (r.next() >= goesOn) return sum;
      const double shines = s->gloss > 0 ? kMirrored : 0;
      double counts;
      if (r.next() < shines) {
        D = mirrored(*s, N, D, r, counts);
        weight /= shines;
      } else {
        D = onward(O, N, r, counts);
        weight *= s->albedo / (1 - shines);
      }
      weight *= counts;
      if (weight == 0) return sum;
    }
  }

  double pixel(int x, int y, Random& r) const {
    const double h = std::tan(0.5 * fov * kPi / 180) * 2 / std::min(width, height);
    const V d = right * ((x + r.next() - 0.5 * width) * h) + up * ((0.5 * height - y - r.next()) * h) + forward;
    return path(eye, unit(d), r);
  }
};

void read(Scene& scene) {
  std::string word;
  double gloss = 0, exponent = 1;
  while (std::cin >> word) {
    Shape s;
    s.gloss = gloss;
    s.exponent = exponent;
    V b, c;
    if (word == "size")
      std::cin >> scene.width >> scene.height;
    else if (word == "camera")
      std::cin >> scene.fov >> scene.eye >> scene.right >> scene.up >> scene.forward;
    else if (word == "sky")
      std::cin >> scene.sky;
    else if (word == "point")
      std::cin >> scene.point >> scene.power;
    else if (word == "gloss")
      std::cin >> gloss >> exponent;
    else if (word == "sphere") {
      std::cin >> s.a >> s.radius >> s.albedo >> s.emitted >> s.v;
      s.ball = true;
      scene.shapes.push_back(s);
    } else {
      std::cin >> s.a >> b >> c;
      s.whole = word != "triangle";
      s.lamp = word == "lamp";
      V d;
      if (s.whole) std::cin >> d;
      if (word != "aim") std::cin >> s.albedo >> s.emitted;
      s.u = b - s.a;
      s.v = (s.whole ? d : c) - s.a;
      (word == "aim" ? scene.aims : scene.shapes).push_back(s);
      if (s.lamp) scene.lamps.push_back(s);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int paths = argc > 1 ? std::atoi(argv[1]) : 256, threads = argc > 2 ? std::atoi(argv[2]) : 2;
  Scene scene;
  read(scene);
  scene.build(0, static_cast<int>(scene.shapes.size()));
  const int columns = scene.width / 8, rows = scene.height / 8;
  std::vector<std::array<double, 2>> blocks(columns * rows);
  const auto work = [&](int first) {
    for (int block = first; block < columns * rows; block += threads) {
      double sum = 0, squares = 0;
      for (int k = 0; k < paths; ++k) {  // each round has one path a pixel, and rounds are independent
        double round = 0;
        for (int i = 0; i < 64; ++i) {
          Random r((static_cast<uint64_t>(block) * 64 + i) * 1000003ull + k);
          round += scene.pixel(block % columns * 8 + i % 8, block / columns * 8 + i / 8, r) / 64;
        }
        sum += round;
        squares += round * round;
      }
      const double mean = sum / paths;
      blocks[block] = {mean, std::sqrt(std::max(0.0, squares / paths - mean * mean) / paths)};
    }
  };
  std::vector<std::thread> pool;
  for (int i = 0; i < threads; ++i) pool.emplace_back(work, i);
  for (std::thread& t : pool) t.join();
  for (const auto& [mean, noise] : blocks) std::printf("%.8g %.3g\n", mean, noise);
}

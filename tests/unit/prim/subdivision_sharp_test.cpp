#include <map>

#include "tests/unit/prim/subdivision.h"

namespace tomales {
namespace {
using namespace test;

/// Catmull-Clark with semi-sharp creases, step by step (T. DeRose, M. Kass, T. Truong 1998, sections 3 and 4), for
/// sharpness in whole numbers: sharp rules while it lasts, one less at each step. Vertices keep their numbers.
struct Stepped {
  using Edge = std::pair<int, int>;
  std::vector<glm::dvec3> p;
  std::vector<std::vector<int>> faces;
  std::map<Edge, int> sharpness;

  static Edge edge(int a, int b) { return std::minmax(a, b); }
  static int other(const Edge& e, int v) { return e.first + e.second - v; }

  struct Rings {
    std::map<Edge, std::vector<size_t>> facesOfEdge;
    std::map<int, std::vector<Edge>> edgesOf;
    std::map<int, std::vector<size_t>> facesOf;
  };
  Rings rings() const {
    Rings r;
    for (size_t f = 0; f < faces.size(); ++f)
      for (size_t k = 0; k < faces[f].size(); ++k) {
        r.facesOfEdge[edge(faces[f][k], faces[f][(k + 1) % faces[f].size()])].push_back(f);
        r.facesOf[faces[f][k]].push_back(f);
      }
    for (const auto& [e, unused] : r.facesOfEdge) {
      r.edgesOf[e.first].push_back(e);
      r.edgesOf[e.second].push_back(e);
    }
    return r;
  }
  bool sharp(const Edge& e) const { return sharpness.contains(e); }

  glm::dvec3 movedVertex(const Rings& r, const std::vector<glm::dvec3>& centers, int v) const {
    std::vector<Edge> creases;
    const std::vector<Edge>& edges = r.edgesOf.at(v);
    std::copy_if(edges.begin(), edges.end(), std::back_inserter(creases), [&](const Edge& e) { return sharp(e); });
    const glm::dvec3 here = p[static_cast<size_t>(v)];
    const auto at = [&](const Edge& e) { return p[static_cast<size_t>(other(e, v))]; };
    if (creases.size() > 2) return here;
    if (creases.size() == 2) return 0.75 * here + 0.125 * (at(creases[0]) + at(creases[1]));
    const double n = static_cast<double>(edges.size());
    glm::dvec3 sum(0);
    for (const Edge& e : edges) sum += at(e);
    for (const size_t f : r.facesOf.at(v)) sum += centers[f];
    return (n - 2) / n * here + sum / (n * n);
  }

  void step() {
    const Rings r = rings();
    std::vector<glm::dvec3> centers, next;
    for (const auto& f : faces) {
      glm::dvec3 sum(0);
      for (const int v : f) sum += p[static_cast<size_t>(v)];
      centers.push_back(sum / static_cast<double>(f.size()));
    }
    for (int v = 0; v < static_cast<int>(p.size()); ++v) next.push_back(movedVertex(r, centers, v));
    std::map<Edge, int> middle, sharper;
    for (const auto& [e, of] : r.facesOfEdge) {
      const glm::dvec3 ends = p[static_cast<size_t>(e.first)] + p[static_cast<size_t>(e.second)];
      const int m = middle[e] = static_cast<int>(next.size());
      next.push_back(sharp(e) ? ends / 2.0 : (ends + centers[of[0]] + centers[of[1]]) / 4.0);
      if (sharp(e) && sharpness[e] > 1) sharper[edge(e.first, m)] = sharper[edge(e.second, m)] = sharpness[e] - 1;
    }
    std::vector<std::vector<int>> quads;
    for (size_t f = 0; f < faces.size(); ++f) {
      const int center = static_cast<int>(next.size());
      next.push_back(centers[f]);
      for (size_t k = 0; k < faces[f].size(); ++k) {
        const int v = faces[f][k], after = faces[f][(k + 1) % faces[f].size()],
                  before = faces[f][(k + faces[f].size() - 1) % faces[f].size()];
        quads.push_back({v, middle[edge(v, after)], center, middle[edge(before, v)]});
      }
    }
    p = std::move(next);
    faces = std::move(quads);
    sharpness = std::move(sharper);
  }

  /// Pre: nothing is sharp any more, all faces are quadrilaterals (Halstead et al. 1993).
  glm::dvec3 limit(int v) const {
    const Rings r = rings();
    const double n = static_cast<double>(r.edgesOf.at(v).size());
    glm::dvec3 sum = n * n * p[static_cast<size_t>(v)];
    for (const Edge& e : r.edgesOf.at(v)) sum += 4.0 * p[static_cast<size_t>(other(e, v))];
    for (const size_t f : r.facesOf.at(v))
      for (size_t k = 0; k < 4; ++k)
        if (faces[f][k] == v) sum += p[static_cast<size_t>(faces[f][(k + 2) % 4])];
    return sum / (n * (n + 5));
  }
};

TEST(SubdivisionLimit, OfSemiSharpCreasesIsThatOfTheirRules) {
  // An octahedron whose waist has sharpness 4 and which two meridians of sharpness 2 cross.
  Cage cage = {{3, 3, 3, 3, 3, 3, 3, 3},
               {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 5, 2, 1, 5, 3, 2, 5, 4, 3, 5, 1, 4},
               {0, 1.414f, 0, 1, 0, 1, -1, 0, 1, -1, 0, -1, 1, 0, -1, 0, -1.414f, 0},
               {1, 2, 2, 3, 3, 4, 4, 1, 0, 1, 1, 5, 5, 3, 3, 0},
               {4, 4, 4, 4, 2, 2, 2, 2}};
  Stepped steps;
  for (size_t k = 0; k < 6; ++k)
    steps.p.emplace_back(cage.points[3 * k], cage.points[3 * k + 1], cage.points[3 * k + 2]);
  for (size_t f = 0; f < 8; ++f)
    steps.faces.emplace_back(cage.vertices.begin() + static_cast<ptrdiff_t>(3 * f),
                             cage.vertices.begin() + static_cast<ptrdiff_t>(3 * f + 3));
  for (size_t k = 0; k < 8; ++k)
    steps.sharpness[Stepped::edge(cage.creaseEdges[2 * k], cage.creaseEdges[2 * k + 1])] =
        static_cast<int>(cage.sharpness[k]);
  for (int k = 0; k < 4; ++k) steps.step();
  const PrimPtr prim = meshOf(cage, "catmull-clark");
  for (uint32_t patch = 0; patch < 24; ++patch) {  // a corner of a face each
    const glm::dvec3 expected = steps.limit(cage.vertices[patch]);
    EXPECT_LT(glm::length(glm::dvec3(sampleAt(*prim, patch, 0, 0).p) - expected), 1e-5) << patch;
  }
}

}  // namespace
}  // namespace tomales

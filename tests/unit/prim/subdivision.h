// A cage and its tags in the making, for tests of subdivision.
#pragma once
#include "tests/unit/prim/support.h"

namespace tomales::test {

inline const std::vector<float> kCube = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1,
                                         -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1};
inline const std::vector<int> kCubeCounts = {4, 4, 4, 4, 4, 4};
inline const std::vector<int> kCubeFaces = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4,
                                            1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};  // outward

/// The arguments of makeSubdivisionMesh().
struct Mesh {
  std::vector<int> counts, vertices;
  ParamList params;
  SubdivisionTags tags = {};
  std::string scheme = "catmull-clark";
  Problems problems = {};

  PrimPtr make() { return makeSubdivisionMesh(scheme, counts, vertices, tags, params, problems); }
  Mesh& tag(const std::string& name, const std::vector<int>& ints = {}, const std::vector<float>& values = {}) {
    tags.names.push_back(name);
    tags.argCounts.insert(tags.argCounts.end(), {static_cast<int>(ints.size()), static_cast<int>(values.size()), 0});
    tags.ints.insert(tags.ints.end(), ints.begin(), ints.end());
    tags.floats.insert(tags.floats.end(), values.begin(), values.end());
    return *this;
  }
};

inline Mesh cube() { return {kCubeCounts, kCubeFaces, {positions(kCube)}, {}}; }

struct Cage {
  std::vector<int> counts, vertices;
  std::vector<float> points;
  std::vector<int> creaseEdges;  // vertex pairs
  std::vector<float> sharpness;
};

inline PrimPtr meshOf(const Cage& cage, const char* scheme) {
  SubdivisionTags tags{{"interpolateboundary"}, {1, 0, 0}, {1}, {}, {}};
  for (size_t k = 0; k < cage.sharpness.size(); ++k) {
    tags.names.push_back("crease");
    tags.argCounts.insert(tags.argCounts.end(), {2, 1, 0});
    tags.ints.insert(tags.ints.end(), {cage.creaseEdges[2 * k], cage.creaseEdges[2 * k + 1]});
    tags.floats.push_back(cage.sharpness[k]);
  }
  Problems problems;
  const PrimPtr prim =
      makeSubdivisionMesh(scheme, cage.counts, cage.vertices, tags, {positions(cage.points)}, problems);
  EXPECT_TRUE(problems.empty());
  return prim;
}

}  // namespace tomales::test

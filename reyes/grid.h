// Noun: one diced piece of a primitive: (nu+1) x (nv+1) vertices, nu x nv micropolygons, structure of arrays in one
// aligned block. Vertex (i, j) has index j * (nu+1) + i, micropolygon (i, j) index j * nu + i.
// A grid is diced once, shared by the buckets that its bound touches, and freed after the last of them.
#pragma once
#include "reyes/base/pool.h"
#include "reyes/scene.h"

namespace tomales {

struct Grid {
  int object = -1;          ///< In Scene::objects.
  uint32_t patch = 0;
  UvRect rect;
  int nu = 0, nv = 0;       ///< Micropolygons along u and v.
  int keyCount = 1;         ///< Motion keys of P (times: Object::keyTimes).
  uint8_t openEdges = 0;    ///< PatchEdge bits: edges of the grid that end the surface; the rest join a neighbour.
  bool displaced = false;
  std::vector<Kept> kept;   ///< What trim curves and the near plane leave of each cell; empty: everything.
  std::vector<mat3> turns;  ///< Linear part of the motion from key 0 to each key.
  uint32_t name = 0;        ///< Stable name of the grid for random numbers.

  int vertexCount() const { return (nu + 1) * (nv + 1); }
  int cellCount() const { return nu * nv; }
  int stride() const { return padded(vertexCount()); }

  /// Arrays, each stride() floats. P in camera space.
  float* P(int key, int axis) { return at(key * 3 + axis); }
  const float* P(int key, int axis) const { return at(key * 3 + axis); }
  float* N(int axis) { return at(keyCount * 3 + axis); }   ///< Shading normal, RISpec side, not normalised.
  const float* N(int axis) const { return at(keyCount * 3 + axis); }
  float* u() { return at(keyCount * 3 + 3); }               ///< Shader's u, v.
  const float* u() const { return at(keyCount * 3 + 3); }
  float* v() { return at(keyCount * 3 + 4); }
  const float* v() const { return at(keyCount * 3 + 4); }
  float* primvar(int offset) { return at(keyCount * 3 + 5 + offset); }
  const float* primvar(int offset) const { return at(keyCount * 3 + 5 + offset); }

  /// Position on the patch of a point of a cell, given in the cell's own (u,v), 0..1.
  vec2 onPatch(int cell, const vec2& at) const {
    return {lerp(rect.u0, rect.u1, (static_cast<float>(cell % nu) + at.x) / static_cast<float>(nu)),
            lerp(rect.v0, rect.v1, (static_cast<float>(cell / nu) + at.y) / static_cast<float>(nv))};
  }
  vec3 position(int key, int vertex) const { return {P(key, 0)[vertex], P(key, 1)[vertex], P(key, 2)[vertex]}; }
  vec3 normal(int vertex) const { return {N(0)[vertex], N(1)[vertex], N(2)[vertex]}; }

  /// Sets the sizes and allocates `keys` positions, the normal, u, v and `primvarFloats` arrays, in a pool if one is given.
  void allocate(int nu, int nv, int keys, int primvarFloats, Pool* pool = nullptr);

 private:
  float* at(int array) { return block_.data() + static_cast<size_t>(array) * static_cast<size_t>(stride()); }
  const float* at(int array) const { return block_.data() + static_cast<size_t>(array) * static_cast<size_t>(stride()); }
  PooledVector<float> block_;
};

/// Unit normals of the surface that the vertices of motion key 0 span, by centred differences, one-sided at the border;
/// `flip` turns them (Object::flipsNormal). Where the lattice is degenerate (a pole), the nearest defined row is used.
void calculateNormals(const Grid& grid, bool flip, float* nx, float* ny, float* nz);

}  // namespace tomales

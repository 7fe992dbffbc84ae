// Noun: diced pieces of one object, all of (nu+1) x (nv+1) vertices and nu x nv micropolygons, structure of arrays in
// one aligned block. A large piece has a grid of its own; small ones share a grid, so that the cost of a grid is paid
// once for dozens of pieces (docs/decisions/0040). They are stacked:
//   vertex (i, j) of piece p         has index  (p * (nv+1) + j) * (nu+1) + i
//   micropolygon (i, j) of piece p   has number (p * (nv+1) + j) * nu + i
// Numbers between the last row of a piece and the next piece name nothing. A grid is diced once, shared by the buckets
// that its bound touches, and freed after the last of them.
#pragma once
#include "reyes/base/pool.h"
#include "reyes/scene.h"

namespace tomales {

/// A rectangle of a patch, to be diced.
struct PatchPiece {
  uint32_t patch = 0;
  UvRect rect;
};

struct Grid {
  struct Piece : PatchPiece {
    uint8_t openEdges = 0;   ///< PatchEdge bits of the edges that end the surface; the others join a neighbour.
    uint32_t sampleKey = 0;  ///< Key of its random numbers (SampleName).
  };

  int object = -1;     ///< Index in Scene::objects.
  int nu = 0, nv = 0;  ///< Micropolygons along u and v of a piece.
  std::vector<Piece> pieces = std::vector<Piece>(1);
  int keyCount = 1;  ///< Motion keys of P (times: Object::keyTimes).
  bool displaced = false;
  /// True if each piece is one cell, shown as the ellipse that touches its four edges. The grid is still and in focus.
  bool round = false;
  /// The part of each cell that trim curves and the near plane keep, by cell number; empty if all of each is kept.
  std::vector<Kept> kept;
  std::vector<mat3> turns;  ///< Linear part of the motion from key 0 to each key.

  int pieceCount() const { return static_cast<int>(pieces.size()); }
  int verticesOfPiece() const { return (nu + 1) * (nv + 1); }
  int vertexCount() const { return pieceCount() * verticesOfPiece(); }
  /// Returns the number of micropolygons.
  int cellCount() const { return pieceCount() * nu * nv; }
  /// Returns the upper limit of cell numbers.
  int cellNumbers() const { return (pieceCount() * (nv + 1) - 1) * nu; }
  bool isCell(int number) const { return number / nu % (nv + 1) != nv; }
  int pieceOfCell(int number) const { return number / (nu * (nv + 1)); }
  /// Returns the number that the cell would have if its piece were alone.
  int cellInPiece(int number) const { return number % (nu * (nv + 1)); }
  int stride() const { return padded(vertexCount()); }

  /// Arrays of stride() floats each. P is in camera space.
  float* P(int key, int axis) { return at(key * 3 + axis); }
  const float* P(int key, int axis) const { return at(key * 3 + axis); }
  float* N(int axis) { return at(keyCount * 3 + axis); }  ///< Shading normal on RISpec's side, not normalised.
  const float* N(int axis) const { return at(keyCount * 3 + axis); }
  float* u() { return at(keyCount * 3 + 3); }  ///< Shader's u and v.
  const float* u() const { return at(keyCount * 3 + 3); }
  float* v() { return at(keyCount * 3 + 4); }
  const float* v() const { return at(keyCount * 3 + 4); }
  float* primvar(int offset) { return at(keyCount * 3 + 5 + offset); }
  const float* primvar(int offset) const { return at(keyCount * 3 + 5 + offset); }

  /// Converts a point of a cell, given in the cell's own (u,v), 0..1, to a position on the patch.
  vec2 onPatch(int cell, const vec2& at) const {
    const UvRect& rect = pieces[static_cast<size_t>(pieceOfCell(cell))].rect;
    const int inPiece = cellInPiece(cell);
    return {lerp(rect.u0, rect.u1, (static_cast<float>(inPiece % nu) + at.x) / static_cast<float>(nu)),
            lerp(rect.v0, rect.v1, (static_cast<float>(inPiece / nu) + at.y) / static_cast<float>(nv))};
  }
  vec3 position(int key, int vertex) const { return {P(key, 0)[vertex], P(key, 1)[vertex], P(key, 2)[vertex]}; }
  vec3 normal(int vertex) const { return {N(0)[vertex], N(1)[vertex], N(2)[vertex]}; }

  /// Sets the sizes of pieces and allocates arrays for all pieces: `keys` positions, the normal, u, v and
  /// `primvarFloats`. pool: provides the memory; may be null.
  void allocate(int nu, int nv, int keys, int primvarFloats, Pool* pool = nullptr);

 private:
  float* at(int array) { return block_.data() + static_cast<size_t>(array) * static_cast<size_t>(stride()); }
  const float* at(int array) const {
    return block_.data() + static_cast<size_t>(array) * static_cast<size_t>(stride());
  }
  PooledVector<float> block_;
};

/// Computes unit normals of the surface through the vertices of motion key 0, by central differences, one-sided at the
/// border. `flip` turns them (Object::flipsNormal). Where the lattice is degenerate (a pole), the nearest defined row
/// is used. Pre: one piece.
void calculateNormals(const Grid& grid, bool flip, float* nx, float* ny, float* nz);

}  // namespace tomales

// Verb: rectangles of patches -> Grid. Evaluates one primitive on regular lattices of equal counts, at every motion
// key.
//   in     object, patches, rectangles and counts that split.h (or a ray tessellator) chose
//   out    vertices: P per key in the space that DiceKeys names, N, (u,v) and every primitive variable
//   never  projects, culls, displaces or shades
// Crack rule: a vertex on an edge depends only on the edge's parameters and its count along it, so neighbours with
// equal counts agree bit for bit; unequal counts are closed by the hider (docs/decisions/0003). Threads: concurrent
// calls are safe.
#pragma once
#include <span>

#include "reyes/grid.h"
#include "reyes/points.h"

namespace tomales {

/// The times at which vertices are evaluated, one motion key each, and the transformation at these:
/// Object::cameraFromObject for the hider, Object::currentFromObject for rays, which do not see the camera move.
struct DiceKeys {
  const std::vector<float>& times;
  const Motion& targetFromObject;
};

/// Dices several pieces of one object, each into nu x nv cells. Each has its own vertices, shared with no other.
/// `pool`: provides the memory of the vertices; may be null.
Grid dice(const Scene& scene, int object, std::span<const PatchPiece> pieces, int nu, int nv, const DiceKeys& at,
          Pool* pool = nullptr);
Grid dice(const Scene& scene, int object, uint32_t patch, const UvRect& rect, int nu, int nv, const DiceKeys& at);
/// Dices at shutter open alone, in current space.
Grid diceAtOpen(const Scene& scene, int object, uint32_t patch, const UvRect& rect, int nu, int nv);

/// A point of the true surface at shutter open, in current space, with the derivatives by the patch's own u and v.
struct TrueSurface {
  vec3 P, dPdu, dPdv;
  vec3 normal;  ///< Normal on the side that RISpec defines, not normalised; 0 where it is not defined.
};
TrueSurface surfaceAt(const Scene& scene, int object, uint32_t patch, float u, float v);

/// Fills one shading point, a ray hit, at patch position (u, v). P and normals are those of the true surface; the
/// caller may overwrite them. `primvarFloats` of the batch must be the object's.
void evaluatePoint(const Scene& scene, int object, uint32_t patch, float u, float v, ShadePoints& batch, int index);
/// Fills the steps of a point right after evaluatePoint(), for a batch with steps: the changes of its values over a
/// footprint of this radius, which also gives du and dv.
void evaluateSteps(const Scene& scene, int object, uint32_t patch, float u, float v, float radius, ShadePoints& batch,
                   int index);

}  // namespace tomales

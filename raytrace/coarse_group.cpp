#include "raytrace/tessellate.h"

namespace tomales {

vec3 CoarseGroup::geometricNormal(uint32_t quad) const {
  const vec3 n = cross(corner(quad, 2) - corner(quad, 0), corner(quad, 3) - corner(quad, 1));
  return normalizeOr(flipsNormal ? -n : n, vec3(0, 0, -1));
}

vec3 CoarseGroup::pointOn(uint32_t quad, float u, float v) const {
  const vec3 a = corner(quad, 0), b = corner(quad, 1), c = corner(quad, 2), d = corner(quad, 3);
  return u + v <= 1 ? a + u * (b - a) + v * (d - a) : c + (1 - u) * (d - c) + (1 - v) * (b - c);
}

vec2 CoarseGroup::patchParameters(uint32_t quad, float u, float v) const {
  const Lattice& l = latticeOf(quad);
  if (l.nu == 1 && l.nv == 1) return {lerp(l.rect.u0, l.rect.u1, u), lerp(l.rect.v0, l.rect.v1, v)};
  const uint32_t cell = quad - l.firstQuad;
  const float fu = (static_cast<float>(cell % l.nu) + u) / static_cast<float>(l.nu);
  const float fv = (static_cast<float>(cell / l.nu) + v) / static_cast<float>(l.nv);
  return {lerp(l.rect.u0, l.rect.u1, fu), lerp(l.rect.v0, l.rect.v1, fv)};
}

size_t CoarseGroup::bytes() const {
  size_t vertices = P.capacity() + N.capacity();
  for (const auto& later : laterP) vertices += later.capacity();
  return vertices * sizeof(vec3) + quads.capacity() * sizeof(Quad) + latticeOfQuad.capacity() * sizeof(uint32_t) +
         lattices.capacity() * sizeof(Lattice);
}

}  // namespace tomales

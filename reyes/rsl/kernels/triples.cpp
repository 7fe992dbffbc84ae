// Triples (RISpec 15.2).
#include "reyes/rsl/kernels/angles.h"
#include "reyes/shader/shadeops.h"

namespace tomales::compiler::kernels {

using rsl::Vec3;

RSL_KERNEL(MakeTriple) {
  for (int b = 0; b < blocks; ++b)
    for (int c = 0; c < 3; ++c) copyBlock(planeOf(out, b, c), planeOf(in[c], b));
}
RSL_KERNEL(Component) {
  each(blocks, out, in, [](Vec3 v, float which) RSL_INLINED {
    return which < 1 ? v.x : which < 2 ? v.y : which >= 2 ? v.z : v.x;
  });
}
RSL_KERNEL(SetComponent) {
  each(blocks, out, in, [](Vec3 v, float which, float value) RSL_INLINED {
    const bool z = which >= 2, y = which >= 1 && which < 2;
    return Vec3{!(which >= 1) ? value : v.x, y ? value : v.y, z ? value : v.z};
  });
}
RSL_KERNEL(Dot) {
  each(blocks, out, in, [](Vec3 a, Vec3 b) RSL_INLINED { return rsl::dot(a, b); });
}
RSL_KERNEL(Cross) {
  each(blocks, out, in, [](Vec3 a, Vec3 b) RSL_INLINED { return rsl::cross(a, b); });
}
RSL_KERNEL(Length) {
  each(blocks, out, in, [](Vec3 a) RSL_INLINED { return rsl::length(a); });
}
RSL_KERNEL(Normalize) {
  each(blocks, out, in, [](Vec3 a) RSL_INLINED { return rsl::normalize(a); });
}
RSL_KERNEL(Reflect) {
  each(blocks, out, in, [](Vec3 I, Vec3 N) RSL_INLINED { return rsl::reflect(I, N); });
}
RSL_KERNEL(Refract) {
  each(blocks, out, in, [](Vec3 I, Vec3 N, float eta) RSL_INLINED { return rsl::refract(I, N, eta); });
}
RSL_KERNEL(Faceforward) {
  each(blocks, out, in, [](Vec3 N, Vec3 I, Vec3 Nref) RSL_INLINED { return rsl::faceforward(N, I, Nref); });
}
RSL_KERNEL(Fresnel) {
  each(blocks, out, in, [](Vec3 I, Vec3 N, float eta) RSL_INLINED { return rsl::fresnel(I, N, eta); });
}
RSL_KERNEL(Ptlined) {
  each(blocks, out, in, [](Vec3 P0, Vec3 P1, Vec3 Q) RSL_INLINED { return rsl::ptlined(P0, P1, Q); });
}
RSL_KERNEL(TripleEqual) {
  each(blocks, out, in, [](Vec3 a, Vec3 b) RSL_INLINED {
    return (a.x == b.x ? 1.0f : 0.0f) * (a.y == b.y ? 1.0f : 0.0f) * (a.z == b.z ? 1.0f : 0.0f);
  });
}

/// Takes Q, the angle in radians, and two points of the axis.
RSL_KERNEL(RotatePoint) {
  for (int b = 0; b < blocks; ++b) {
    const Angles angles(planeOf(in[1], b));
    const Plane<Vec3> to(out, b), Q(in[0], b), P0(in[2], b), P1(in[3], b);
    RSL_LANES
    for (int k = 0; k < kBlock; ++k)
      to.set(k, rsl::rotated(Q.get(k), cosineOf(angles[k]), sineOf(angles[k]), P0.get(k), P1.get(k)));
  }
}

}  // namespace tomales::compiler::kernels

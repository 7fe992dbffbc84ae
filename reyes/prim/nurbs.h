// Private to NuPatch and to patch meshes with weights: NURBS as rational Bezier pieces of any order.
#pragma once
#include "reyes/prim_factories.h"

namespace tomales {

constexpr int kHighestOrder = 32;

/// A knot interval that is not empty, cut to the range that is drawn, as a piece of a Bezier curve.
struct BezierSpan {
  /// Index of the interval, counting empty ones. Its controls are the `order` ones from index `segment` on.
  int segment;
  float begin, end;             ///< Knot values.
  float cornerFrom, cornerTo;   ///< `begin` and `end` as fractions of the knot interval.
  std::vector<double> weights;  ///< Row k of `order` holds the weights of the controls in Bezier control k.
};

/// Checks and cuts one direction; throws PrimError if it is no B-spline. Spans that meet without a jump have
/// bit-identical weights there.
std::vector<BezierSpan> bezierSpans(const NurbsDirection& line, const char* name, Problems& problems);

/// Homogeneous controls, u fastest; not owned.
struct RationalNet {
  const vec4* controls;
  int uOrder, vOrder;
};

struct RationalPoint {
  glm::dvec3 p, du, dv;
};

RationalPoint evaluateRational(const RationalNet& net, double u, double v);
/// Evaluates a patch. Where the derivatives span no plane, because the length of their cross product is at most
/// `degenerate`, the normal is that of a point slightly nearer to the middle.
void evaluateRational(const RationalNet& net, double degenerate, int n, const float* u, const float* v,
                      const SurfacePoints& out);

/// Interpolates a vertex variable, weighted like the positions, so that values stay where they are on the surface.
/// convert(controlOf, out) appends the Bezier controls of the patch to `out`. It calls controlOf(index) for a
/// homogeneous control.
template <class Convert>
void interpolateRational(const Primvar& var, const std::vector<vec4>& controls, int uOrder, int vOrder,
                         const Convert& convert, int n, const float* u, const float* v, float* out, int stride) {
  for (int c = 0; c < var.width; c += 3) {
    const int many = std::min(3, var.width - c);
    const auto controlOf = [&](size_t control) {
      glm::dvec4 h(0, 0, 0, controls[control].w);
      for (int k = 0; k < many; ++k)
        h[k] = h.w * var.values[control * static_cast<size_t>(var.width) + static_cast<size_t>(c + k)];
      return h;
    };
    std::vector<vec4> values;
    convert(controlOf, values);
    for (int i = 0; i < n; ++i) {
      const glm::dvec3 value = evaluateRational({values.data(), uOrder, vOrder}, u[i], v[i]).p;
      for (int k = 0; k < many; ++k) out[static_cast<ptrdiff_t>(c + k) * stride + i] = static_cast<float>(value[k]);
    }
  }
}

/// Returns the bound of the controls of the piece over the rectangle, which contains it. Pre: weights are positive.
Bound3 boundRational(const RationalNet& net, const UvRect& rect);

}  // namespace tomales

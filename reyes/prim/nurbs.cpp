#include "reyes/prim/nurbs.h"

#include <fmt/format.h>

#include "reyes/prim/interpolation.h"

namespace tomales {
namespace {

[[noreturn]] void refuse(const char* name, const std::string& what) {
  throw PrimError(fmt::format("along {}, {}", name, what));
}

void requireBSpline(const NurbsDirection& line, const char* name) {
  if (line.order < 2 || line.order > kHighestOrder)
    refuse(name, fmt::format("the order is {}; it can be 2 to {}", line.order, kHighestOrder));
  if (line.controls < line.order)
    refuse(name, fmt::format("{} control points are too few for order {}", line.controls, line.order));
  const size_t needed = static_cast<size_t>(line.controls) + static_cast<size_t>(line.order);
  if (line.knots.size() != needed)
    refuse(name, fmt::format("there are {} knots where {} controls of order {} need {}", line.knots.size(),
                             line.controls, line.order, needed));
  for (size_t k = 0; k < needed; ++k) {
    if (!std::isfinite(line.knots[k])) refuse(name, fmt::format("knot {} is not a finite number", k));
    if (k && line.knots[k] < line.knots[k - 1]) refuse(name, fmt::format("knot {} is less than the one before", k));
  }
  if (!std::isfinite(line.min) || !std::isfinite(line.max)) refuse(name, "the range is not finite");
}

/// Computes the weights of a span's controls in its polar form at `arguments`, of which there are `degree` (de Boor's
/// recursion backwards; L. Ramshaw, "Blossoms are polar forms", 1989). knots[0] and knots[1] are the knots before and
/// after the span.
void polarWeights(const float* knots, int degree, const double* arguments, double* weights) {
  std::fill_n(weights, degree, 0.0);
  weights[degree] = 1;
  for (int level = degree; level > 0; --level)
    for (int i = level; i <= degree; ++i) {
      const double low = knots[i - degree], high = knots[i - level + 1];
      const double alpha = (arguments[level - 1] - low) / (high - low);
      weights[i - 1] += (1 - alpha) * weights[i];
      weights[i] *= alpha;
    }
}

BezierSpan makeSpan(const NurbsDirection& line, int segment, float begin, float end) {
  const int degree = line.order - 1;
  const float* knots = &line.knots[static_cast<size_t>(segment + degree)];
  const float length = knots[1] - knots[0];
  BezierSpan span{segment, begin, end, (begin - knots[0]) / length, (end - knots[0]) / length, {}};
  span.weights.resize(static_cast<size_t>(line.order * line.order));
  double arguments[kHighestOrder];
  std::fill_n(arguments, degree, static_cast<double>(begin));
  for (int k = 0; k <= degree; ++k) {
    if (k) arguments[k - 1] = end;
    polarWeights(knots, degree, arguments, &span.weights[static_cast<size_t>(k * line.order)]);
  }
  return span;
}

/// Sets the first weights of `next` to the last ones of `last`: they are the same except for rounding, and weights of
/// controls that only one of the two has are zero.
void join(const BezierSpan& last, BezierSpan& next, int order) {
  const int shift = next.segment - last.segment;
  const double* end = &last.weights[static_cast<size_t>(order * (order - 1))];
  for (int i = 0; i < order; ++i) next.weights[static_cast<size_t>(i)] = i + shift < order ? end[i + shift] : 0.0;
}

void bernstein(int degree, double t, double* value, double* derivative) {
  value[0] = 1;
  for (int d = 1; d <= degree; ++d) {
    if (d == degree)
      for (int k = 0; k <= degree; ++k)
        derivative[k] = degree * ((k > 0 ? value[k - 1] : 0) - (k < degree ? value[k] : 0));
    value[d] = t * value[d - 1];
    for (int k = d - 1; k > 0; --k) value[k] = t * value[k - 1] + (1 - t) * value[k];
    value[0] *= 1 - t;
  }
}

/// Computes controls of the curve's piece over [t0, t1], in place at c, c + step, ... (blossoming).
void restrictCurve(glm::dvec4* c, int step, int order, double t0, double t1) {
  glm::dvec4 piece[kHighestOrder], d[kHighestOrder];
  for (int k = 0; k < order; ++k) {
    for (int i = 0; i < order; ++i) d[i] = c[i * step];
    for (int level = 1; level < order; ++level) {
      const double t = level <= k ? t1 : t0;
      for (int i = 0; i + level < order; ++i) d[i] = (1 - t) * d[i] + t * d[i + 1];
    }
    piece[k] = d[0];
  }
  for (int k = 0; k < order; ++k) c[k * step] = piece[k];
}

vec3 fromHomogeneous(const glm::dvec4& h) { return vec3(glm::dvec3(h) / h.w); }

}  // namespace

std::vector<BezierSpan> bezierSpans(const NurbsDirection& line, const char* name, Problems& problems) {
  requireBSpline(line, name);
  const size_t first = static_cast<size_t>(line.order) - 1, last = static_cast<size_t>(line.controls);
  const float low = std::max(line.min, line.knots[first]), high = std::min(line.max, line.knots[last]);
  if (low > line.min || high < line.max)
    problems.push_back(fmt::format("its range {} to {} along {} is more than the knots define; it was cut to {} to {}",
                                   line.min, line.max, name, low, high));
  std::vector<BezierSpan> spans;
  for (size_t k = first; k < last; ++k) {
    const float begin = std::max(low, line.knots[k]), end = std::min(high, line.knots[k + 1]);
    if (!(begin < end)) continue;
    BezierSpan span = makeSpan(line, static_cast<int>(k - first), begin, end);
    // If as many knots as the order are equal, the curve may jump.
    if (!spans.empty() && span.segment - spans.back().segment < line.order) join(spans.back(), span, line.order);
    spans.push_back(std::move(span));
  }
  if (spans.empty()) refuse(name, fmt::format("the range {} to {} is empty", line.min, line.max));
  return spans;
}

RationalPoint evaluateRational(const RationalNet& net, double u, double v) {
  double bu[kHighestOrder], du[kHighestOrder], bv[kHighestOrder], dv[kHighestOrder];
  bernstein(net.uOrder - 1, u, bu, du);
  bernstein(net.vOrder - 1, v, bv, dv);
  glm::dvec4 h(0), hu(0), hv(0);
  const vec4* control = net.controls;
  for (int j = 0; j < net.vOrder; ++j) {
    glm::dvec4 row(0), rowByU(0);
    for (int i = 0; i < net.uOrder; ++i, ++control) {
      const glm::dvec4 c(*control);
      row += bu[i] * c;
      rowByU += du[i] * c;
    }
    h += bv[j] * row;
    hu += bv[j] * rowByU;
    hv += dv[j] * row;
  }
  const glm::dvec3 p = glm::dvec3(h) / h.w;
  return {p, (glm::dvec3(hu) - p * hu.w) / h.w, (glm::dvec3(hv) - p * hv.w) / h.w};
}

namespace {

vec3 normalOf(const RationalNet& net, double degenerate, const RationalPoint& s, double u, double v) {
  const glm::dvec3 normal = glm::cross(s.du, s.dv);
  if (glm::length(normal) > degenerate) return vec3(normal);
  return vec3(glm::normalize(normalNearby(u, v, 1e-6, [&](double a, double b) {
    const RationalPoint nearby = evaluateRational(net, a, b);
    return std::pair(nearby.du, nearby.dv);
  })));
}

}  // namespace

void evaluateRational(const RationalNet& net, double degenerate, int n, const float* u, const float* v,
                      const SurfacePoints& out) {
  for (int i = 0; i < n; ++i) {
    const RationalPoint s = evaluateRational(net, u[i], v[i]);
    setFrame(out, i, vec3(s.p), vec3(s.du), vec3(s.dv));
    setNormal(out, i, normalOf(net, degenerate, s, u[i], v[i]));
  }
}

Bound3 boundRational(const RationalNet& net, const UvRect& rect) {
  const int count = net.uOrder * net.vOrder;
  std::vector<glm::dvec4> c(net.controls, net.controls + count);
  Bound3 whole, bound;
  for (const glm::dvec4& h : c) whole.extend(fromHomogeneous(h));
  for (int j = 0; j < net.vOrder; ++j)
    restrictCurve(&c[static_cast<size_t>(j * net.uOrder)], 1, net.uOrder, rect.u0, rect.u1);
  for (int i = 0; i < net.uOrder; ++i)
    restrictCurve(&c[static_cast<size_t>(i)], net.uOrder, net.vOrder, rect.v0, rect.v1);
  for (const glm::dvec4& h : c) bound.extend(fromHomogeneous(h));
  return paddedForRounding(bound, whole);
}

}  // namespace tomales

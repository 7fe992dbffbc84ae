// Non-uniform rational B-spline surfaces (RISpec section 5.2), with one patch for each pair of knot intervals.
#include <fmt/format.h>

#include <optional>

#include "reyes/prim/interpolation.h"
#include "reyes/prim/nurbs.h"
#include "reyes/prim/primvars.h"
#include "reyes/prim/trim_region.h"

namespace tomales {
namespace {

/// One direction of the surface, over the range that is drawn.
struct Side {
  int controls, order;
  std::vector<BezierSpan> spans;
  int segments() const { return controls - order + 1; }
  int corners() const { return segments() + 1; }
  int patches() const { return static_cast<int>(spans.size()); }
  double weight(int span, int bezier, int control) const {
    return spans[static_cast<size_t>(span)].weights[static_cast<size_t>(bezier * order + control)];
  }
  /// Parameter of the surface, which runs from 0 to 1 over the whole range.
  float parameter(int span, float t) const {
    const BezierSpan& s = spans[static_cast<size_t>(span)];
    return (lerp(s.begin, s.end, t) - spans.front().begin) / (spans.back().end - spans.front().begin);
  }
  float alongSegment(int span, float t) const {
    const BezierSpan& s = spans[static_cast<size_t>(span)];
    return lerp(s.cornerFrom, s.cornerTo, t);
  }
};

Side makeSide(const NurbsDirection& line, const char* name, Problems& problems) {
  return {line.controls, line.order, bezierSpans(line, name, problems)};
}

PrimvarCounts countsOf(const Side& u, const Side& v) {
  const auto product = [](int a, int b) { return static_cast<size_t>(a) * static_cast<size_t>(b); };
  const size_t corners = product(u.corners(), v.corners());
  return {product(u.segments(), v.segments()), corners, product(u.controls, v.controls), corners};
}

class NuPatch : public Prim {
 public:
  NuPatch(Side u, Side v, std::optional<TrimRegion> trim, const ParamList& params, Problems& problems)
      : Prim(takePrimvars(params, countsOf(u, v), problems)),
        u_(std::move(u)),
        v_(std::move(v)),
        trim_(std::move(trim)) {
    controls_ = takeHomogeneous(params, static_cast<size_t>(u_.controls) * static_cast<size_t>(v_.controls));
    for (uint32_t patch = 0; patch < patchCount(); ++patch)
      convert(
          patch, [&](size_t control) { return glm::dvec4(controls_[control]); }, nets_);
    for (const vec4& h : nets_)
      if (!(h.w > 0)) throw PrimError("its weights are not positive everywhere");
    const glm::dvec3 extent(wholeBound().size());
    degenerate_ = 1e-5 * glm::dot(extent, extent) / patchCount();
  }

  uint32_t patchCount() const override {
    return static_cast<uint32_t>(u_.patches()) * static_cast<uint32_t>(v_.patches());
  }
  PatchInfo info(uint32_t patch) const override { return {.openEdges = findOpenEdges(patch)}; }
  Bound3 bound(uint32_t patch, const UvRect& rect) const override { return boundRational(net(patch), rect); }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    evaluateRational(net(patch), degenerate_, n, u, v, out);
  }

  void surfaceParameters(uint32_t patch, int n, const float* u, const float* v, float* su, float* sv) const override {
    for (int k = 0; k < n; ++k) {
      su[k] = u_.parameter(column(patch), u[k]);
      sv[k] = v_.parameter(row(patch), v[k]);
    }
  }

  Kept kept(uint32_t patch, const UvRect& r) const override {
    if (!trim_) return Kept::All;
    return trim_->kept({u_.parameter(column(patch), r.u0), v_.parameter(row(patch), r.v0)},
                       {u_.parameter(column(patch), r.u1), v_.parameter(row(patch), r.v1)});
  }
  bool keeps(uint32_t patch, float u, float v) const override {
    return !trim_ || trim_->keeps({u_.parameter(column(patch), u), v_.parameter(row(patch), v)});
  }

  void interpolate(uint32_t patch, int index, int n, const float* u, const float* v, float* out,
                   int stride) const override {
    const Primvar& var = primvars_[static_cast<size_t>(index)];
    if (repeatIfEven(var, segmentNumber(patch), n, out, stride)) return;
    if (var.storage == Storage::Vertex)
      interpolateVertex(patch, var, n, u, v, out, stride);
    else
      interpolateCorners(patch, var, n, u, v, out, stride);
  }

 private:
  int column(uint32_t patch) const { return static_cast<int>(patch) % u_.patches(); }
  int row(uint32_t patch) const { return static_cast<int>(patch) / u_.patches(); }
  /// Returns the index of a patch's segment in rows of `width`, in segments or controls.
  size_t numberInRows(uint32_t patch, int width) const {
    const int u = u_.spans[static_cast<size_t>(column(patch))].segment,
              v = v_.spans[static_cast<size_t>(row(patch))].segment;
    return static_cast<size_t>(v) * static_cast<size_t>(width) + static_cast<size_t>(u);
  }
  size_t segmentNumber(uint32_t patch) const { return numberInRows(patch, u_.segments()); }
  RationalNet net(uint32_t patch) const {
    return {&nets_[patch * static_cast<size_t>(u_.order * v_.order)], u_.order, v_.order};
  }

  /// Appends the Bezier controls of a patch; controlOf(number) is a homogeneous control of the whole.
  template <class ControlOf>
  void convert(uint32_t patch, const ControlOf& controlOf, std::vector<vec4>& out) const {
    const size_t corner = numberInRows(patch, u_.controls);
    for (int l = 0; l < v_.order; ++l)
      for (int k = 0; k < u_.order; ++k) {
        glm::dvec4 sum(0);
        for (int j = 0; j < v_.order; ++j) {
          glm::dvec4 along(0);
          for (int i = 0; i < u_.order; ++i)
            along += u_.weight(column(patch), k, i) * controlOf(corner + static_cast<size_t>(j * u_.controls + i));
          sum += v_.weight(row(patch), l, j) * along;
        }
        out.push_back(vec4(sum));
      }
  }

  Bound3 wholeBound() const {
    Bound3 bound;
    for (const vec4& h : nets_) bound.extend(vec3(h) / h.w);
    return bound;
  }

  std::vector<vec4> edge(uint32_t patch, PatchEdge bit) const {
    const bool alongV = bit == kEdgeU0 || bit == kEdgeU1;
    const int first = bit == kEdgeU1 ? u_.order - 1 : bit == kEdgeV1 ? u_.order * (v_.order - 1) : 0;
    std::vector<vec4> points;
    for (int k = 0; k < (alongV ? v_.order : u_.order); ++k)
      points.push_back(net(patch).controls[first + k * (alongV ? u_.order : 1)]);
    return points;
  }

  /// An edge is closed if it is a point, or if it equals the opposite edge of the next patch, also around the ends of
  /// the surface, because a NURBS has no other way to be closed.
  uint8_t findOpenEdges(uint32_t patch) const {
    const auto patchAt = [&](int i, int j) {
      return static_cast<uint32_t>((j + v_.patches()) % v_.patches() * u_.patches() +
                                   (i + u_.patches()) % u_.patches());
    };
    const auto open = [&](PatchEdge mine, PatchEdge theirs, int du, int dv) {
      const std::vector<vec4> points = edge(patch, mine);
      const auto sameAsFirst = [&](const vec4& h) { return vec3(h) / h.w == vec3(points[0]) / points[0].w; };
      if (std::all_of(points.begin(), points.end(), sameAsFirst)) return 0;
      return points == edge(patchAt(column(patch) + du, row(patch) + dv), theirs) ? 0 : static_cast<int>(mine);
    };
    return static_cast<uint8_t>(open(kEdgeU0, kEdgeU1, -1, 0) | open(kEdgeU1, kEdgeU0, 1, 0) |
                                open(kEdgeV0, kEdgeV1, 0, -1) | open(kEdgeV1, kEdgeV0, 0, 1));
  }

  void interpolateCorners(uint32_t patch, const Primvar& var, int n, const float* u, const float* v, float* out,
                          int stride) const {
    const uint32_t width = static_cast<uint32_t>(u_.corners());
    const uint32_t first = static_cast<uint32_t>(numberInRows(patch, u_.corners()));
    std::vector<float> along(static_cast<size_t>(2 * n));
    for (int i = 0; i < n; ++i) {
      along[static_cast<size_t>(i)] = u_.alongSegment(column(patch), u[i]);
      along[static_cast<size_t>(n + i)] = v_.alongSegment(row(patch), v[i]);
    }
    interpolateBilinear(var.values.data(), var.width, {first, first + 1, first + width, first + width + 1}, n,
                        along.data(), along.data() + n, out, stride);
  }

  void interpolateVertex(uint32_t patch, const Primvar& var, int n, const float* u, const float* v, float* out,
                         int stride) const {
    interpolateRational(
        var, controls_, u_.order, v_.order,
        [&](const auto& controlOf, auto& values) { convert(patch, controlOf, values); }, n, u, v, out, stride);
  }

  size_t shapeBytes() const override { return bytesOf(controls_) + bytesOf(nets_); }
  const Side u_, v_;
  const std::optional<TrimRegion> trim_;
  std::vector<vec4> controls_;
  std::vector<vec4> nets_;  // Bezier controls, patch by patch
  double degenerate_ = 0;   // the least length of a normal that can be told from rounding
};

}  // namespace

PrimPtr makeNuPatch(const NurbsDirection& u, const NurbsDirection& v, const TrimLoops& trim, const ParamList& params,
                    Problems& problems) {
  Side uSide = makeSide(u, "u", problems), vSide = makeSide(v, "v", problems);
  std::optional<TrimRegion> region;
  if (!trim.loops.empty()) {
    const vec2 begin(uSide.spans.front().begin, vSide.spans.front().begin);
    const vec2 end(uSide.spans.back().end, vSide.spans.back().end);
    try {
      region.emplace(trim, begin, end, problems);
    } catch (const PrimError& e) {
      problems.push_back(fmt::format("it is not trimmed: {}", e.what()));
    }
  }
  return std::make_shared<NuPatch>(std::move(uSide), std::move(vSide), std::move(region), params, problems);
}

}  // namespace tomales

// Patch meshes of homogeneous controls (RISpec section 5.2, "Pw").
#include <fmt/format.h>

#include "reyes/prim/nurbs.h"
#include "reyes/prim/patch_mesh.h"

namespace tomales {
namespace {

const Param* weightedPositions(const ParamList& params) {
  return findParam(params, "P") || findParam(params, "Pz") ? nullptr : findParam(params, "Pw");
}

/// Returns the controls unchanged. Weights of 0 are allowed, because some bases have tangents among their controls.
std::vector<vec4> takeControls(const ParamList& params, size_t count) {
  const std::vector<float>& f = weightedPositions(params)->floats;
  if (f.size() != 4 * count)
    throw PrimError(fmt::format("Pw has {} values where {} vertices need {} floats", f.size(), count, 4 * count));
  std::vector<vec4> out;
  for (size_t i = 0; i < count; ++i) {
    out.emplace_back(f[4 * i], f[4 * i + 1], f[4 * i + 2], f[4 * i + 3]);
    if (!isFinite(vec3(out.back())) || !std::isfinite(out.back().w))
      throw PrimError(fmt::format("Pw of vertex {} is not a finite number", i));
  }
  return out;
}

class RationalMesh : public PatchMesh {
 public:
  RationalMesh(const Layout& mesh, int order, const ToBezier& u, const ToBezier& v, const ParamList& params,
               Problems& problems)
      : PatchMesh(mesh, params, problems),
        order_(order),
        uToBezier_(u),
        vToBezier_(v),
        controls_(takeControls(params, mesh.controls())) {
    for (uint32_t patch = 0; patch < mesh.patches(); ++patch)
      convert(
          patch, [&](size_t control) { return glm::dvec4(controls_[control]); }, nets_);
    Bound3 whole;
    for (const vec4& h : nets_) {
      if (!(h.w > 0)) throw PrimError("its weights are not positive everywhere");
      whole.extend(vec3(h) / h.w);
    }
    degenerate_ = 1e-5 * glm::dot(glm::dvec3(whole.size()), glm::dvec3(whole.size())) / mesh.patches();
  }

  PatchInfo info(uint32_t patch) const override {
    const auto edge = [&](uint32_t p, PatchEdge bit) {
      const int last = order_ - 1, step = bit == kEdgeU0 || bit == kEdgeU1 ? order_ : 1;
      const int first = bit == kEdgeU1 ? last : bit == kEdgeV1 ? last * order_ : 0;
      std::vector<vec4> points;
      for (int k = 0; k < order_; ++k) points.push_back(net(p).controls[first + k * step]);
      return points;
    };
    return {false, findOpenEdges(patch, edge)};
  }

  Bound3 bound(uint32_t patch, const UvRect& rect) const override { return boundRational(net(patch), rect); }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    evaluateRational(net(patch), degenerate_, n, u, v, out);
  }

 protected:
  void interpolateVertex(uint32_t patch, const Primvar& var, int n, const float* u, const float* v, float* out,
                         int stride) const override {
    interpolateRational(
        var, controls_, order_, order_, [&](const auto& controlOf, auto& values) { convert(patch, controlOf, values); },
        n, u, v, out, stride);
  }

 private:
  RationalNet net(uint32_t patch) const {
    return {&nets_[patch * static_cast<size_t>(order_ * order_)], order_, order_};
  }

  /// Appends the Bezier controls of a patch; controlOf(number) is a homogeneous control of the whole.
  template <class ControlOf>
  void convert(uint32_t patch, const ControlOf& controlOf, std::vector<vec4>& out) const {
    for (int l = 0; l < order_; ++l)
      for (int k = 0; k < order_; ++k) {
        glm::dvec4 sum(0);
        for (int j = 0; j < order_; ++j)
          for (int i = 0; i < order_; ++i)
            sum += double{vToBezier_[static_cast<size_t>(l)][static_cast<size_t>(j)]} *
                   double{uToBezier_[static_cast<size_t>(k)][static_cast<size_t>(i)]} *
                   controlOf(mesh_.controlOf(patch, i, j));
        out.push_back(vec4(sum));
      }
  }

  size_t shapeBytes() const override { return bytesOf(controls_) + bytesOf(nets_); }
  const int order_;
  const ToBezier uToBezier_, vToBezier_;
  std::vector<vec4> controls_, nets_;  // nets_: Bezier controls, patch by patch
  double degenerate_ = 0;              // the least length of a normal that can be told from rounding
};

}  // namespace

bool isRational(const ParamList& params) {
  const Param* pw = weightedPositions(params);
  if (!pw) return false;
  for (size_t i = 3; i < pw->floats.size(); i += 4)
    if (pw->floats[i] != pw->floats[3]) return true;
  return false;
}

PrimPtr makeRationalMesh(const Layout& mesh, int order, const ToBezier& u, const ToBezier& v, const ParamList& params,
                         Problems& problems) {
  return std::make_shared<RationalMesh>(mesh, order, u, v, params, problems);
}

}  // namespace tomales

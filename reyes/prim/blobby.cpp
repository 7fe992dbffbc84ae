// Blobby (PRMan's implicit surfaces). A patch is a quadrilateral of a coarse mesh, and evaluating it moves its points
// onto the surface: positions are exact at every dicing rate, and derivatives follow from the field's gradient.
#include <fmt/format.h>

#include "reyes/base/stop.h"
#include "reyes/prim/blobby_code.h"
#include "reyes/prim/blobby_mesh.h"
#include "reyes/prim/interpolation.h"
#include "reyes/prim/primvars.h"
#include "reyes/prim/sampled_bound.h"

namespace tomales {
namespace {

/// A point of a patch's mesh and its path to the surface, with derivatives.
struct Way {
  dvec3 p, pu, pv, outward, outwardU, outwardV;
  double reach;
};

struct SurfacePoint {
  dvec3 p, du, dv, normal;
};

/// What happens to a point whose path does not meet the surface.
enum class Lost {
  Stays,  ///< It stays on the mesh, which belongs to this surface and so lies near it.
  /// It goes to the end of its path, since the mesh belongs to another key time. Points that meet the surface lie
  /// within the same reach, so the shape does not jump where points begin to miss it.
  GoesOn,
};

SurfacePoint pointOn(const BlobField& field, const Way& way, Lost lost) {
  const std::optional<double> met = meetSurface(field, way.p, way.outward, way.reach);
  double t = met.value_or(0);
  if (!met && lost == Lost::GoesOn) t = std::copysign(way.reach, field.at(way.p).value - kBlobSurface);
  SurfacePoint s{way.p + t * way.outward, way.pu + t * way.outwardU, way.pv + t * way.outwardV, way.outward};
  const dvec3 gradient = field.at(s.p).gradient;
  const double slope = glm::dot(gradient, way.outward);
  if (!met || !(std::abs(slope) > 1e-6 * glm::length(gradient))) return s;
  // Along u and v, f(p + t outward) is constant.
  s.du -= glm::dot(gradient, s.du) / slope * way.outward;
  s.dv -= glm::dot(gradient, s.dv) / slope * way.outward;
  s.normal = -gradient;
  return s;
}

class Blobby : public Prim {
 public:
  Blobby(const BlobField& field, BlobMesh mesh, Lost lost, std::vector<Primvar> primvars)
      : Prim(std::move(primvars)), field_(field), mesh_(std::move(mesh)), lost_(lost) {
    fields_.reserve(mesh_.quads.size());
    for (uint32_t patch = 0; patch < patchCount(); ++patch) {
      throwIfStopped();
      const Bound3 hull = hullOf(patch, {});
      fields_.push_back(field.within({hull.lo, hull.hi}));
    }
  }

  size_t leafCount() const { return field_.leafCount(); }
  BlobMesh carriedTo(const BlobField& moved) const { return carriedMesh(mesh_, field_, moved); }

  uint32_t patchCount() const override { return static_cast<uint32_t>(mesh_.quads.size()); }
  PatchInfo info(uint32_t) const override { return {.openEdges = 0}; }

  Bound3 bound(uint32_t patch, const UvRect& rect) const override {
    const Bound3 hull = hullOf(patch, rect);
    // it is too coarse for a few samples to represent the rest
    if (!mesh_.complete) return paddedForRounding(hull, hull);
    const Bound3 sampled = boundOfSamples(
        rect, [&](float u, float v) { return vec3(pointOn(fields_[patch], wayAt(patch, u, v), lost_).p); });
    return paddedForRounding({glm::max(hull.lo, sampled.lo), glm::min(hull.hi, sampled.hi)}, hull);
  }

  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    for (int i = 0; i < n; ++i) {
      const SurfacePoint s = pointOn(fields_[patch], wayAt(patch, u[i], v[i]), lost_);
      setFrame(out, i, vec3(s.p), vec3(s.du), vec3(s.dv));
      setNormal(out, i, normalizeOr(vec3(s.normal), vec3(0, 0, 1)));
    }
  }

  /// Blends the leaves' values, each weighted by its share of the field there.
  void interpolate(uint32_t patch, int index, int n, const float* u, const float* v, float* out,
                   int stride) const override {
    const Primvar& var = primvars_[static_cast<size_t>(index)];
    if (repeatIfEven(var, 0, n, out, stride)) return;
    for (int i = 0; i < n; ++i) {
      const BlobField& field = fields_[patch];
      std::vector<double> weights = field.leafWeights(pointOn(field, wayAt(patch, u[i], v[i]), lost_).p);
      double sum = 0;
      for (const double w : weights) sum += w;
      if (!(sum > 0)) {
        weights.assign(weights.size(), 1);
        sum = static_cast<double>(weights.size());
      }
      for (int c = 0; c < var.width; ++c) {
        double value = 0;
        for (size_t leaf = 0; leaf < weights.size(); ++leaf)
          value += weights[leaf] * var.values[leaf * static_cast<size_t>(var.width) + static_cast<size_t>(c)];
        out[static_cast<ptrdiff_t>(c) * stride + i] = static_cast<float>(value / sum);
      }
    }
  }

 private:
  const BlobVertex& corner(uint32_t patch, int k) const {
    return mesh_.vertices[mesh_.quads[patch].corners[static_cast<size_t>(k)]];
  }

  Way wayAt(uint32_t patch, double u, double v) const {
    // On an edge only two products are not zero. Their sum does not depend on their order, so it is the same for both
    // patches.
    const auto blend = [&](const auto& of) {
      return (of(0) * (1 - u) + of(1) * u) * (1 - v) + (of(2) * (1 - u) + of(3) * u) * v;
    };
    const auto byU = [&](const auto& of) { return (of(1) - of(0)) * (1 - v) + (of(3) - of(2)) * v; };
    const auto byV = [&](const auto& of) { return (of(2) - of(0)) * (1 - u) + (of(3) - of(1)) * u; };
    const auto position = [&](int k) { return dvec3(corner(patch, k).position); };
    const auto outward = [&](int k) { return dvec3(corner(patch, k).outward); };
    const auto reach = [&](int k) { return static_cast<double>(corner(patch, k).reach); };
    return {blend(position), byU(position), byV(position), blend(outward), byU(outward), byV(outward), blend(reach)};
  }

  /// Returns the bound of the points that pointOn() may give for a rectangle.
  Bound3 hullOf(uint32_t patch, const UvRect& rect) const {
    std::array<vec3, 4> corners;
    float reach = 0;
    for (int k = 0; k < 4; ++k) {
      corners[static_cast<size_t>(k)] = corner(patch, k).position;
      reach = std::max(reach, corner(patch, k).reach);
    }
    return boundBilinear(corners, rect).grown(reach);
  }

  const BlobField field_;
  const BlobMesh mesh_;
  const Lost lost_;
  std::vector<BlobField> fields_;  // by patch
};

}  // namespace

namespace {

/// The parts of a parsed request.
struct Read {
  BlobProgram program;
  std::vector<Primvar> primvars;
};

Read readBlobby(int leafCount, const std::vector<int>& code, const std::vector<float>& floats,
                const GroundReader& grounds, const ParamList& params, Problems& problems) {
  BlobProgram program = readBlobProgram(code, floats, grounds, problems);
  if (static_cast<size_t>(std::max(0, leafCount)) != program.leafCount)
    problems.push_back(fmt::format("it announces {} leaves and has {}", leafCount, program.leafCount));
  const size_t n = program.leafCount;
  return {std::move(program), takePrimvars(params, {1, n, n, n}, problems)};
}

}  // namespace

PrimPtr makeBlobby(int leafCount, const std::vector<int>& code, const std::vector<float>& floats,
                   const GroundReader& grounds, const ParamList& params, Problems& problems) {
  Read read = readBlobby(leafCount, code, floats, grounds, params, problems);
  BlobMesh mesh = contour(read.program.field, read.program.box);
  if (!mesh.complete)
    problems.push_back(
        "a leaf is so drawn out, or so much smaller than others, that details of its shape may be missed");
  return std::make_shared<Blobby>(read.program.field, std::move(mesh), Lost::Stays, std::move(read.primvars));
}

PrimPtr makeBlobbyKey(const Prim& first, int leafCount, const std::vector<int>& code, const std::vector<float>& floats,
                      const GroundReader& grounds, const ParamList& params, Problems& problems) {
  Read read = readBlobby(leafCount, code, floats, grounds, params, problems);
  const auto* blobby = dynamic_cast<const Blobby*>(&first);
  if (!blobby || blobby->leafCount() != read.program.leafCount)
    return makeBlobby(leafCount, code, floats, grounds, params, problems);
  return std::make_shared<Blobby>(read.program.field, blobby->carriedTo(read.program.field), Lost::GoesOn,
                                  std::move(read.primvars));
}

}  // namespace tomales

// A Volume: the box that holds its density.
#include "reyes/density.h"
#include "reyes/prim_factories.h"

namespace tomales {
namespace {

/// Six faces whose normals point outwards.
PrimPtr boxOf(const Bound3& b, Problems& problems) {
  Param points{"P", Storage::Vertex, ValueType::Point, 1, {}, {}, {}};
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k) points.floats.push_back(b.corner(i)[k]);
  return makePolygons({4, 4, 4, 4, 4, 4}, {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6},
                      {points}, problems);
}

class Volume final : public Prim {
 public:
  Volume(PrimPtr box, std::shared_ptr<const DensityGrid> density)
      : Prim({}), box_(std::move(box)), density_(std::move(density)) {}

  uint32_t patchCount() const override { return box_->patchCount(); }
  PatchInfo info(uint32_t patch) const override { return box_->info(patch); }
  Bound3 bound(uint32_t patch, const UvRect& rect) const override { return box_->bound(patch, rect); }
  void evaluate(uint32_t patch, int n, const float* u, const float* v, SurfacePoints out) const override {
    box_->evaluate(patch, n, u, v, out);
  }
  void interpolate(uint32_t, int, int, const float*, const float*, float*, int) const override {}
  std::optional<std::array<vec3, 2>> straightEdge(uint32_t patch, PatchEdge edge) const override {
    return box_->straightEdge(patch, edge);
  }
  const DensityGrid* density() const override { return density_.get(); }

 private:
  size_t shapeBytes() const override { return box_->bytes() + density_->bytes(); }

  const PrimPtr box_;
  const std::shared_ptr<const DensityGrid> density_;
};

}  // namespace

PrimPtr makeVolume(std::shared_ptr<const DensityGrid> density, Problems& problems) {
  PrimPtr box = boxOf(density->bound(), problems);
  return std::make_shared<Volume>(std::move(box), std::move(density));
}

}  // namespace tomales

// The records of a shot as another camera sees them.
#include "gi/icf.h"

namespace tomales {
namespace {

/// Moves records to another space. Lengths are multiplied by the scale. A rotation gradient, which is used with a cross
/// product, changes its sign where the handedness changes.
class RecordMove {
 public:
  explicit RecordMove(const mat4& to)
      : to_(to), scale_(lengthScale(to)), hand_(glm::determinant(mat3(to)) < 0 ? -1.0f : 1.0f) {
    if (std::abs(scale_ - 1) < 1e-5f) scale_ = 1;  // the transformation is rigid, except for rounding
  }

  void apply(IrradianceRecord& r) const {
    r.position = transformPoint(to_, r.position);
    r.normal = turned(r.normal);
    for (vec3& d : r.dominant) d = turned(d);
    r.tangent = turned(r.tangent);
    moveDerivatives(r.light);
    for (IrradianceExpansion& share : r.shares) moveDerivatives(share);
    for (float* length : {&r.harmonicMean, &r.closest, &r.smoothRadius, &r.limit, &r.pixelSize, &r.unseenDisplacement})
      *length *= scale_;
  }

 private:
  void moveDerivatives(IrradianceExpansion& light) const {
    for (int c = 0; c < 3; ++c) {
      light.rotationGradient[c] = hand_ * turned(light.rotationGradient[c]);
      light.translationGradient[c] = turned(light.translationGradient[c]) / scale_;
    }
    for (vec3& second : light.hessian) second /= scale_ * scale_;
    light.hessian[1] *= hand_;
  }
  vec3 turned(const vec3& v) const { return transformVector(to_, v) / scale_; }

  const mat4 to_;
  float scale_;
  const float hand_;
};

}  // namespace

void moveToCamera(IrradianceShot& shot, const mat4& cameraFromWorld) {
  if (shot.cameraFromWorld == cameraFromWorld) return;
  const mat4 m = cameraFromWorld * glm::inverse(shot.cameraFromWorld);
  const RecordMove move(m);
  for (PreparedCache& prepared : shot.caches) {
    IrradianceCache moved(transformBound(m, prepared.cache.bound()), prepared.key.cache);
    for (IrradianceRecord r : prepared.cache.records()) {
      move.apply(r);
      moved.restore(r);
    }
    prepared.cache = std::move(moved);
  }
  shot.cameraFromWorld = cameraFromWorld;
  shot.learnt = nullptr;
}

}  // namespace tomales

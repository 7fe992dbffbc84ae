// Irradiance records that go from one camera to another.
#include "gi/icf.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace tomales {
namespace {

/// A record gives the same light at a place and a normal, whatever the scale and the handedness of the camera that
/// asks.
TEST(Records, SayTheSameToEveryCamera) {
  const mat4 turn = glm::rotate(glm::translate(mat4(1.0f), vec3(1, -2, 3)), 0.7f, normalizeOr(vec3(1, 2, -1), vec3(1)));
  const vec3 x(0.04f, -0.03f, 0), n = normalizeOr(vec3(0.05f, 0.02f, 1), vec3(0));
  for (const ErrorFunction function : {ErrorFunction::Screen, ErrorFunction::Ward, ErrorFunction::Hessian}) {
    IrradianceRecord r{};
    r.normal = {0, 0, 1};
    r.light.E = {1, 2, 3};
    r.tangent = normalizeOr(vec3(2, 1, 0), vec3(0));
    r.light.hessian[0] = vec3(5);
    r.light.hessian[1] = vec3(-9);
    r.light.hessian[2] = vec3(4);
    r.harmonicMean = 2;
    r.closest = 0.3f;
    r.smoothRadius = 0.2f;
    r.limit = 0.25f;
    r.pixelSize = 0.02f;
    for (int c = 0; c < 3; ++c) {
      r.dominant[c] = normalizeOr(vec3(c, 1, 2), vec3(0));
      r.light.rotationGradient[c] = {0.3f, -0.2f, 0.1f};
      r.light.translationGradient[c] = {0.4f, 0.5f, 0};
    }
    const auto ask = [&](const mat4& m, float scale) {
      IrradianceShot shot;
      shot.cameraFromWorld = mat4(1.0f);
      CacheKey key;
      key.cache = {function, 1};
      shot.caches.push_back({key, IrradianceCache({vec3(-1), vec3(1)}, key.cache)});
      shot.caches[0].cache.restore(r);
      moveToCamera(shot, m);
      const vec3 normal = normalizeOr(transformVector(m, n), vec3(0));
      return shot.caches[0].cache.lookup(transformPoint(m, x), normal, 0.02f * scale);
    };
    const IrradianceEstimate truth = ask(mat4(1.0f), 1);
    ASSERT_GT(truth.weight, 0.1f);
    for (const float scale : {1.0f, 0.01f, 100.0f})
      for (const float hand : {1.0f, -1.0f}) {
        const mat4 m = turn * glm::scale(mat4(1.0f), vec3(hand * scale, scale, scale));
        const IrradianceEstimate found = ask(m, scale);
        EXPECT_NEAR(found.weight, truth.weight, 1e-3f * truth.weight) << scale << " " << hand;
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(found.E[c], truth.E[c], 1e-4f) << scale << " " << hand;
          EXPECT_LT(glm::distance(found.dominant[c], normalizeOr(transformVector(m, truth.dominant[c]), vec3(0))),
                    1e-4f);
        }
      }
  }
}

}  // namespace
}  // namespace tomales

// Properties of splitting and dicing, for bodies and views that RapidCheck makes up.
#include <glm/gtc/matrix_transform.hpp>

#include "reyes/dice.h"
#include "tests/unit/made_up.h"
#include "tests/unit/split/test_scene.h"

namespace tomales::test {
namespace {

/// A sphere or a plane, turned and stretched, that may lie partly beside the view and behind the eye.
Scene madeUpScene() {
  const PrimPtr shape = *rc::gen::arbitrary<bool>() ? sphere() : quad(3, -0.7f);
  const float shadingRate = *numberIn(0.5f, 64), degrees = *numberIn(-180, 180), depth = *numberIn(0.25f, 12);
  const vec3 beside = madeUpVector(-2, 2), axis = madeUpVector(-1, 1), scale = madeUpVector(0.125f, 2);
  const mat4 turned = dot(axis, axis) > 0 ? glm::rotate(mat4(1), glm::radians(degrees), glm::normalize(axis)) : mat4(1);
  return sceneOf({shape}, translation({beside.x, beside.y, depth}) * turned * glm::scale(mat4(1), scale), shadingRate);
}

std::vector<SubPatch> splitIn(const Scene& scene, const PixelRect& window) {
  std::vector<uint32_t> patches(scene.objects[0].shape().patchCount());
  std::iota(patches.begin(), patches.end(), 0U);
  Stats stats;
  Log log(Log::Verbosity::Quiet);
  const Camera camera(scene.options);
  return splitPatches({scene, camera, window, stats, log}, 0, patches);
}

Grid diced(const Scene& scene, const SubPatch& p) { return diceAtOpen(scene, p.object, p.patch, p.rect, p.nu, p.nv); }

auto placeOf(const SubPatch& p) {
  return std::make_tuple(p.patch, p.rect.u0, p.rect.v0, p.rect.u1, p.rect.v1, p.nu, p.nv);
}

RC_GTEST_PROP(Pieces, DoNotOverlapOnTheirPatch, ()) {
  const Scene scene = madeUpScene();
  const std::vector<SubPatch> pieces = splitIn(scene, Camera(scene.options).crop());
  RC_PRE(!pieces.empty());
  for (size_t i = 0; i < pieces.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      const UvRect &a = pieces[i].rect, &b = pieces[j].rect;
      const bool apart = a.u1 <= b.u0 || b.u1 <= a.u0 || a.v1 <= b.v0 || b.v1 <= a.v0;
      RC_ASSERT(pieces[i].patch != pieces[j].patch || apart);
    }
}

RC_GTEST_PROP(Pieces, HaveTheirVerticesWithinTheirBounds, ()) {
  const Scene scene = madeUpScene();
  const Camera camera(scene.options);
  const std::vector<SubPatch> pieces = splitIn(scene, camera.crop());
  RC_PRE(!pieces.empty());
  for (const SubPatch& p : pieces) {
    if (p.crossesEye) continue;
    const Grid g = diced(scene, p);
    for (int i = 0; i < g.vertexCount(); ++i) {
      if (g.P(0, 2)[i] < camera.nearClip()) continue;  // not seen, so the bound need not hold it
      const vec2 at = camera.raster(g.position(0, i));
      RC_ASSERT(at.x >= p.raster.lo.x && at.x <= p.raster.hi.x && at.y >= p.raster.lo.y && at.y <= p.raster.hi.y);
      RC_ASSERT(g.P(0, 2)[i] >= p.zMin - 1e-5f * std::abs(p.zMin));
    }
  }
}

RC_GTEST_PROP(Pieces, ThatShareAWholeEdgeShareItsVertices, ()) {
  const Scene scene = madeUpScene();
  const std::vector<SubPatch> pieces = splitIn(scene, Camera(scene.options).crop());
  RC_PRE(pieces.size() > 1);
  for (const SubPatch& a : pieces)
    for (const SubPatch& b : pieces) {
      if (a.patch != b.patch) continue;
      const UvRect &p = a.rect, &q = b.rect;
      const bool beside = p.u1 == q.u0 && p.v0 == q.v0 && p.v1 == q.v1 && a.nv == b.nv,
                 below = p.v1 == q.v0 && p.u0 == q.u0 && p.u1 == q.u1 && a.nu == b.nu;
      if (!beside && !below) continue;
      const Grid g = diced(scene, a), h = diced(scene, b);
      for (int j = 0; beside && j <= a.nv; ++j)
        RC_ASSERT(g.position(0, j * (a.nu + 1) + a.nu) == h.position(0, j * (b.nu + 1)));
      for (int i = 0; below && i <= a.nu; ++i) RC_ASSERT(g.position(0, a.nv * (a.nu + 1) + i) == h.position(0, i));
    }
}

RC_GTEST_PROP(Pieces, ThatReachIntoASmallerWindowAreAmongItsPieces, ()) {
  const Scene scene = madeUpScene();
  const int x = *test::wholeIn(0, 96), y = *test::wholeIn(0, 96), size = *test::wholeIn(1, 33);
  const PixelRect window{x, y, x + size, y + size};
  const Camera camera(scene.options);
  const auto isSeen = [&](const SubPatch& p) {
    const Grid g = diced(scene, p);
    Bound2 raster;
    for (int i = 0; i < g.vertexCount(); ++i) raster.extend(camera.raster(g.position(0, i)));
    return raster.lo.x < static_cast<float>(window.x1) && raster.hi.x > static_cast<float>(window.x0) &&
           raster.lo.y < static_cast<float>(window.y1) && raster.hi.y > static_cast<float>(window.y0);
  };
  std::vector<decltype(placeOf(SubPatch{}))> ofWindow, ofWhole;
  for (const SubPatch& p : splitIn(scene, window)) ofWindow.push_back(placeOf(p));
  for (const SubPatch& p : splitIn(scene, camera.crop()))
    if (!p.crossesEye && isSeen(p)) ofWhole.push_back(placeOf(p));
  RC_PRE(!ofWhole.empty());
  std::sort(ofWindow.begin(), ofWindow.end());
  std::sort(ofWhole.begin(), ofWhole.end());
  RC_ASSERT(std::includes(ofWindow.begin(), ofWindow.end(), ofWhole.begin(), ofWhole.end()));
}

}  // namespace
}  // namespace tomales::test

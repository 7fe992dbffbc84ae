#include "reyes/image/view.h"

namespace tomales {

Metadata matrixEntry(const char* name, const mat4& m) {
  // RenderMan's matrices act on rows from the right and are stored by rows: that is glm's storage.
  return {name, "", std::vector<float>(&m[0][0], &m[0][0] + 16)};
}

std::vector<Metadata> cameraOf(const View& view) {
  mat4 ndcFromScreen(1.0f);
  ndcFromScreen[0][0] = 0.5f;
  ndcFromScreen[1][1] = -0.5f;
  ndcFromScreen[3] = {0.5f, 0.5f, 0, 1};
  return {matrixEntry("worldtocamera", view.cameraFromWorld),
          matrixEntry("worldToNDC", ndcFromScreen * view.screenFromWorld),
          {"near", "", {view.near}},
          {"far", "", {view.far}}};
}

View viewOf(const Camera& camera, const mat4& cameraFromWorld) {
  const vec2 size(camera.xResolution(), camera.yResolution());
  const vec2 center = camera.raster({0, 0, 1}), scale = camera.raster({1, 1, 1}) - center;
  const vec2 toScreen(2 / size.x, -2 / size.y), origin = center * toScreen + vec2(-1, 1), stretch = scale * toScreen;
  mat4 screenFromCamera(1.0f);
  screenFromCamera[0][0] = stretch.x;
  screenFromCamera[1][1] = stretch.y;
  const int last = camera.perspective() ? 2 : 3;  // index of the component that divides x and y: z, or none
  screenFromCamera[last][0] = origin.x;
  screenFromCamera[last][1] = origin.y;
  if (camera.perspective()) {
    screenFromCamera[2][3] = 1;
    screenFromCamera[3][3] = 0;
    screenFromCamera[3][2] = -camera.nearClip();
  }
  return {cameraFromWorld, screenFromCamera * cameraFromWorld, camera.nearClip(), camera.farClip()};
}

}  // namespace tomales

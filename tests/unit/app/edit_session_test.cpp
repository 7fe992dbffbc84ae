#include "reyes/app/relight/edit_session.h"

#include <gtest/gtest.h>

#include "reyes/shader_registry.h"

namespace tomales {
namespace {

TEST(EditSession, ItsEndWakesTheThreadThatBeginsMeanwhile) {
  Log log;
  ShaderRegistry registry(log);
  const Scene scene;
  const Editable editable(scene, registry, {});
  DeepFrame frame;
  frame.crop = {0, 0, 8, 8};
  const PictureParts parts(frame, frame.crop);
  EditSession session(EditedLayers({{"whole", {}}, {"", {}}}, editable, {}), parts);
  session.end();
  EXPECT_FALSE(session.begin());
  session.wait();
  EXPECT_TRUE(session.hasEnded());
}

}  // namespace
}  // namespace tomales

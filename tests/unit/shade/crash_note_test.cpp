// What the message of a crash says of the shader that was running.
#include <cstdlib>

#include "reyes/base/crash_note.h"
#include "reyes/shader.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

/// Tells who is running, as when a shader does not return, and ends the program.
void telling(const TmGrid*) {
  markNotes();
  tellLastingNote();
  std::_Exit(0);
}
const rsl::Shader tellingSurface(TM_SURFACE, "telling", "", 0, telling, {});
const rsl::Shader tellingLight(TM_LIGHT, "tellinglight", "", 0, telling, {});

class CrashNotes : public Stage {
 protected:
  CrashNotes() {
    ::testing::GTEST_FLAG(death_test_style) = "threadsafe";
    static const TmShader* const shaders[] = {tellingSurface, tellingLight};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
  }
};

TEST_F(CrashNotes, NameTheObjectOfASurfaceOnce) {
  surface("telling");
  EXPECT_EXIT(shadeOne(), ::testing::ExitedWithCode(0), "stage.rib:7: \"thing\": surface shader \"telling\"");
}

TEST_F(CrashNotes, NameALightAndTheObjectThatItShinesOn) {
  surface("matte");
  light("tellinglight");
  EXPECT_EXIT(shadeOne(), ::testing::ExitedWithCode(0),
              "stage.rib:5: .*tellinglight.*, on \"thing\": light shader \"tellinglight\"");
}

}  // namespace
}  // namespace tomales

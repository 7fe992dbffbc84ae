// A volume of ABI 1, in the words of RSL. It asks for light by name and for a space, as translations from RSL do.
#include <reyes/sl.h>

using namespace sl;

namespace {
rsl::FloatParam clear("clear", 0.5f, "share that passes"), glow("glow", 0, "weight of the light on the way");

struct frozen : Volume {
  void main() {
    Color Li;
    illuminance(P - 0.5 * I, [&] { Li += Cl; });
    Float above = ycomp(transform("world", P));
    Color kept = Ci * clear + glow * Li;
    If(above > -1000, [&] { Ci = kept; });
  }
};
const rsl::Shader shader(TM_VOLUME, "frozen_volume", "of ABI 1", 0, sl::shade<frozen>, {&clear, &glow});
}  // namespace

TM_SHADER_LIBRARY(shader)

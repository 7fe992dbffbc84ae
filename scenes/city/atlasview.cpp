// Shows the light that an irradiance atlas holds where the eye looks: a brick map's E/pi, or the light of a matte
// surface.
//     c++ -std=c++20 -O2 -fPIC -shared -I ../.. atlasview.cpp -o FOLDER/atlasview.so
#include <reyes/sl.h>

using namespace sl;

namespace {
rsl::StringParam map("map", "", "brick map of irradiance"),
    texturename("texturename", "", "picture of the colour; none: irradiance alone");

struct atlasview : Surface {
  void main() {
    const std::string picture = texturename(grid());
    Ci = photonmap(map(grid()), P, faceforward(normalize(N), I));
    if (!picture.empty()) Ci = Ci * Cs * Color(texture(picture.c_str())) * 0.9;
    Oi = Os;
  }
};
const rsl::Shader shader(TM_SURFACE, "atlasview", "irradiance of a brick map", TM_KEEPS_OPACITY | TM_DERIVATIVES,
                         sl::shade<atlasview>, {&map, &texturename});
}  // namespace

TM_SHADER_LIBRARY(shader)

// The patterns of reyes/shader/sl_patterns.h are those of the RSL headers: the same shader in both languages.
#include "reyes/shader/sl_patterns.h"

#include <fstream>

#include "reyes/rsl.h"
#include "tests/unit/shade/stage.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

constexpr const char* kWritten = R"RSL(
#include "noises.h"
#include "patterns.h"
surface pulses_written() {
  float x = 7 * u - 3;
  Ci = color(filteredpulse(-1, .5, x, .3), filteredpulsetrain(.3, .7, x, .2), filteredpulse(0, 1, x, 0));
  Oi = 1;
}
surface octaves_written() {
  point p = 9 * P;
  Ci = color(fBm(p, .1, 5, 2.1, .6), turbulence(p, .3, 4, 2, .5), filteredsnoise(p, .5));
  Oi = 1;
}
)RSL";

struct pulses : sl::Surface {
  void main() {
    const sl::Float x = 7 * u - 3;
    Ci = sl::Color(sl::filteredpulse(-1, 0.5f, x, 0.3f), sl::filteredpulsetrain(0.3f, 0.7f, x, 0.2f),
                   sl::filteredpulse(0, 1, x, 0));
    Oi = sl::Color(1);
  }
};
struct octaves : sl::Surface {
  void main() {
    const sl::Point p = 9 * P;
    Ci = sl::Color(sl::fBm(p, 0.1f, 5, 2.1f, 0.6f), sl::turbulence(p, 0.3f), sl::filteredsnoise(p, 0.5f));
    Oi = sl::Color(1);
  }
};
struct widths : sl::Surface {
  void main() {
    Ci = sl::Color(sl::filterwidth(u), sl::filterwidth(3 * u - v * v), sl::filterwidthp(P));
    Oi = sl::Color(1);
  }
};
const rsl::Shader pulsesShader(TM_SURFACE, "pulses", "", 0, sl::shade<pulses>, {}),
    octavesShader(TM_SURFACE, "octaves", "", 0, sl::shade<octaves>, {}),
    widthsShader(TM_SURFACE, "widths", "", TM_DERIVATIVES | TM_NEIGHBOURS, sl::shade<widths>, {});

constexpr int kPoints = 64;

class Patterns : public Stage {
 protected:
  Patterns() {
    static const TmShader* const shaders[] = {pulsesShader, octavesShader, widthsShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
    const std::string path = test::temporary("tomales_patterns.sl");
    std::ofstream(path) << kWritten;
    const auto file = RslFile::compile(path, {});
    EXPECT_EQ(file->errors(), 0) << file->messages();
    EXPECT_TRUE(registry.addText(file, path));
  }
  std::vector<vec3> seen(const std::string& name) {
    shading.reset();
    scene.objects.clear();
    surface(name);
    system();
    ShadePoints p(0, 0, true);
    for (int k = 0; k < kPoints; ++k) {
      const int i = p.add(static_cast<uint32_t>(k));
      const float u = static_cast<float>(k) / kPoints, v = std::sin(float(k)), du = 0.001f * float(k), dv = 0.02f;
      p.channel(kU)[i] = p.channel(kS)[i] = u;
      p.channel(kV)[i] = p.channel(kT)[i] = v;
      p.channel(kDu)[i] = du;
      p.channel(kDv)[i] = dv;
      p.step(kStepU, false)[i] = du;
      p.step(kStepV, true)[i] = dv;
      p.set3(kPx, i, {2 * u, 4 * v, 5});
      p.set3(kDpduX, i, {2, 0, 0});
      p.set3(kDpdvX, i, {0, 4, 0});
      p.set3(kNx, i, {0, 0, -1});
      p.set3(kNgx, i, {0, 0, -1});
      p.set3(kIx, i, p.position(i));
    }
    const ShadedPoints out = shade(p);
    std::vector<vec3> colors;
    for (int i = 0; i < kPoints; ++i) colors.push_back(out.color(i));
    return colors;
  }
};

TEST_F(Patterns, OfBothLanguagesAreTheSame) {
  for (const std::string name : {"pulses", "octaves"}) {
    const auto is = seen(name), should = seen(name + "_written");
    float least = 1e9f, most = -1e9f;
    for (size_t i = 0; i < is.size(); ++i) {
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(is[i][k], should[i][k], 2e-5f) << name << " " << i << " " << k;
      least = std::min(least, is[i].x);
      most = std::max(most, is[i].x);
    }
    EXPECT_GT(most, least) << name << " does not vary";
  }
  for (const LogEntry& e : log.entries()) ADD_FAILURE() << e.message;
}

TEST_F(Patterns, WidthsAreThoseOfTheMicropolygon) {
  const auto width = seen("widths");
  for (int k = 1; k < kPoints; ++k) {
    const float du = 0.001f * float(k), dv = 0.02f, v = std::sin(float(k));
    EXPECT_NEAR(width[size_t(k)].x, du, 1e-5f) << k;
    EXPECT_NEAR(width[size_t(k)].y, 3 * du + std::abs(2 * v) * dv, 2e-4f) << k;
    EXPECT_NEAR(width[size_t(k)].z, std::sqrt(2 * du * 4 * dv), 1e-4f) << k;
  }
}

// What a box of width 0.2 sees of pulses is their mean where it spans whole periods.
TEST_F(Patterns, FilteredPulsesKeepTheirMean) {
  double sum = 0;
  for (const vec3& c : seen("pulses")) sum += c.y;
  EXPECT_NEAR(sum / kPoints, 0.3 / 0.7, 0.01);
}

}  // namespace
}  // namespace tomales

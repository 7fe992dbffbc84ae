// A surface and a volume that ask what light arrives as a test says, and a light that counts the points that it is
// asked for.
#pragma once
#include "reyes/sl.h"
#include "tests/unit/shade/stage.h"

namespace tomales {

inline std::function<void(sl::Surface&)> onSurface;
inline std::function<void(sl::Volume&)> inVolume;
struct outside : sl::Surface {
  void main() {
    Ci = sl::Color(-1.0);
    Oi = sl::Color(1.0);
    onSurface(*this);
  }
};
struct between : sl::Volume {
  void main() { inVolume(*this); }
};

// A light that counts its points, says what it has been told and what it sees of the surface.
inline int litPoints = 0;
inline rsl::FloatParam power("power", 1, "");
inline rsl::ColorParam tint("tint", {1, 1, 1}, "");
inline rsl::StringParam word("word", "unsaid", "");
inline rsl::UniformFloatParam whole("whole", 0, "");
inline rsl::FloatOutput doubled("doubled", ""), normalLength("normallength", ""), facetLength("facetlength", "");
inline void shadeCounting(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) {
    ++litPoints;
    const rsl::Vec3 P = rsl::get(g->P, i), N = rsl::get(g->N, i);
    doubled.set(g, i, 2 * power(g, i));
    normalLength.set(g, i, rsl::length(N));
    facetLength.set(g, i, rsl::length(rsl::get(g->Ng, i)));
    b.illuminate(i, rsl::Vec3{0, 0, -1} - P,
                 (std::string_view(word(g)) == "said" ? 100.0f : 1.0f) * power(g, i) * tint(g, i));
  }
}

inline const rsl::Shader outsideShader(TM_SURFACE, "outside", "", TM_TRACES, sl::shade<outside>, {});
inline const rsl::Shader betweenShader(TM_VOLUME, "between", "", 0, sl::shade<between>, {});
inline const rsl::Shader countingShader(TM_LIGHT, "counting", "", 0, shadeCounting,
                                        {&power, &tint, &word, &whole, &doubled, &normalLength, &facetLength});

class Elsewhere : public Stage {
 protected:
  Elsewhere() {
    static const TmShader* const shaders[] = {outsideShader, betweenShader, countingShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
    surface("outside");
    litPoints = 0;
  }
  /// Ci of `n` points at z = 5, u from 0 on; `what` runs for all.
  ShadedPoints asked(int n, const std::function<void(sl::Surface&)>& what, const ShadeContext& context = {}) {
    onSurface = what;
    return shade(points(std::vector<vec3>(static_cast<size_t>(n), vec3(0, 0, 5))), context);
  }
  /// Returns what is seen of a black surface at z = `depth` through the volume.
  vec3 through(float depth, const std::function<void(sl::Volume&)>& what) {
    attributes.atmosphere = std::make_shared<const ShaderCall>(call("between", {}));
    onSurface = [](sl::Surface& s) { s.Ci = sl::Color(); };
    inVolume = what;
    ShadePoints p = points({vec3(0, 0, depth)});
    p.set3(kIx, 0, vec3(0, 0, depth));
    ShadedPoints out;
    system().shade(p, {}, out);
    system().atmosphere(p, out);
    return out.color(0);
  }
};

}  // namespace tomales

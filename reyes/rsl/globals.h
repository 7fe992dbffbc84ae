// The variables that every shader of a kind has (RISpec 3.2, tables 12.1 to 12.5): one table for the checker, the
// passes and the machine.
#pragma once
#include <cstdint>
#include <string_view>

#include "reyes/rsl/code.h"

namespace tomales::compiler {

// clang-format off
// The columns are name, base, uniform, the kinds that may read it, the kinds that may assign it. S L D V I are the
// kinds of ShaderKind. (Transformation shaders count as displacements: docs/rsl.md.)
#define RSL_GLOBALS(G)                                                                                    \
  G(P, Point, false, "SLDVI", "D")    G(N, Normal, false, "SLDV", "SD")  G(Ng, Normal, false, "SLDV", "") \
  G(I, Vector, false, "SDVL", "")     G(E, Point, true, "SLDVI", "")     G(Cs, Color, false, "SLDV", "")  \
  G(Os, Color, false, "SLDV", "")     G(dPdu, Vector, false, "SLDV", "") G(dPdv, Vector, false, "SLDV", "") \
  G(u, Float, false, "SLDVI", "")      G(v, Float, false, "SLDVI", "")     G(s, Float, false, "SLDVI", "")   \
  G(t, Float, false, "SLDVI", "")      G(du, Float, false, "SLDV", "")    G(dv, Float, false, "SLDV", "")  \
  G(dPdtime, Vector, false, "SLDV", "") G(time, Float, true, "SLDVI", "") G(dtime, Float, true, "SLDVI", "") \
  G(ncomps, Float, true, "SLDVI", "") G(Ci, Color, false, "SVI", "SVI")  G(Oi, Color, false, "SVI", "SVI") \
  G(L, Vector, false, "SLV", "L")     G(Cl, Color, false, "SLV", "L")    G(Ol, Color, false, "SLV", "L")  \
  G(Ps, Point, false, "SLV", "")        G(Ns, Normal, false, "L", "")      G(alpha, Float, false, "I", "I") \
  /* not of RISpec: depths of the clipping planes, for depth() */                                         \
  G(__near, Float, true, "SLDVI", "") G(__far, Float, true, "SLDVI", "")
// clang-format on

enum class Global : uint8_t {
#define RSL_GLOBAL(name, base, uniform, readers, writers) name,
  RSL_GLOBALS(RSL_GLOBAL)
#undef RSL_GLOBAL
};

struct GlobalInfo {
  Global global;
  std::string_view name;
  Base base;
  bool uniform;
  std::string_view readers, writers;
  bool readableIn(ShaderKind kind) const;
  bool writableIn(ShaderKind kind) const;
};
const GlobalInfo& info(Global global);
/// Returns null if there is no global of this name.
const GlobalInfo* findGlobal(std::string_view name);
constexpr int kGlobals = static_cast<int>(Global::__far) + 1;

}  // namespace tomales::compiler

#include "reyes/rsl/globals.h"

#include <array>

namespace tomales::compiler {
namespace {

constexpr std::array<GlobalInfo, kGlobals> kTable = {{
#define RSL_GLOBAL(name, base, uniform, readers, writers) {Global::name, #name, Base::base, uniform, readers, writers},
    RSL_GLOBALS(RSL_GLOBAL)
#undef RSL_GLOBAL
}};

/// Transformation shaders move points, as displacements do.
char letter(ShaderKind kind) { return "SLDVID"[static_cast<int>(kind)]; }

}  // namespace

bool GlobalInfo::readableIn(ShaderKind kind) const { return readers.find(letter(kind)) != std::string_view::npos; }
bool GlobalInfo::writableIn(ShaderKind kind) const { return writers.find(letter(kind)) != std::string_view::npos; }

const GlobalInfo& info(Global global) { return kTable[static_cast<size_t>(global)]; }

const GlobalInfo* findGlobal(std::string_view name) {
  for (const GlobalInfo& g : kTable)
    if (g.name == name) return &g;
  return nullptr;
}

}  // namespace tomales::compiler

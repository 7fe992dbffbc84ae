// Finds the files that a shader reads while it runs, such as textures: their names stand in its text, are parameters,
// or are computed.
#include <dlfcn.h>

#include "reyes/rsl/hosted_shader.h"
#include "reyes/rsl/passes/walk.h"

namespace tomales {
namespace compiler {
namespace {

bool isText(const Code& code, int32_t r) {
  return r >= 0 && code.registers[static_cast<size_t>(r)].shape == Shape::Text;
}

/// Tells whether the instruction hands on a text that it takes.
bool handsOn(Op op) { return op == Op::Copy || op == Op::Select || op == Op::ElementS || op == Op::SetElement; }

/// Returns for each register whether it may hold a text that is neither constant nor a parameter: computed, or told by
/// others.
std::vector<char> unknownTexts(const Code& code) {
  std::vector<char> out(code.registers.size(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    forEach(code.body, [&](const Instruction& i) {
      bool unknown = !handsOn(i.op);
      for (const int32_t r : i.in) unknown |= isText(code, r) && out[static_cast<size_t>(r)];
      forEachWrite(i, [&](int32_t r) {
        if (!unknown || !isText(code, r) || out[static_cast<size_t>(r)]) return;
        out[static_cast<size_t>(r)] = 1;
        changed = true;
      });
    });
  }
  return out;
}

/// Returns the register with the name of the file that the instruction reads; negative if it reads none.
int32_t fileOf(const Code& code, const Instruction& i) {
  switch (i.op) {
    case Op::Shadow:
    case Op::TextureF:
    case Op::TextureT:
    case Op::EnvironmentF:
    case Op::EnvironmentT:
    case Op::TextureInfo:
    case Op::Texture3d:
    case Op::PhotonMap:
    case Op::Subsurface:
      return i.in[0];
    case Op::Occlusion:
    case Op::IndirectDiffuse:
      for (const Setting& s : i.settings)
        if (const auto& name = code.registers[static_cast<size_t>(s.name)].texts;
            !name.empty() && name[0] == "filename")
          return s.value;
      return -1;
    default:
      return -1;
  }
}

void addReads(const Code& code, RslReads& out) {
  for (const Builtin* function : code.plugins)
    if (Dl_info plugin{}; dladdr(reinterpret_cast<const void*>(function->plugin), &plugin) != 0 && plugin.dli_fname)
      out.names.emplace_back(plugin.dli_fname);
  const std::vector<char> unknown = unknownTexts(code);
  bool any = false;
  forEach(code.body, [&](const Instruction& i) {
    const int32_t file = fileOf(code, i);
    if (file < 0) return;
    any = true;
    if (unknown[static_cast<size_t>(file)]) out.isKnown = false;
  });
  if (!any) return;
  for (const Register& r : code.registers)
    if (r.origin == Origin::Constant) out.names.insert(out.names.end(), r.texts.begin(), r.texts.end());
  for (const Parameter& p : code.parameters) out.names.insert(out.names.end(), p.texts.begin(), p.texts.end());
}

}  // namespace
}  // namespace compiler

RslReads rslReads(const TmShader& shader) {
  RslReads out;
  for (const compiler::HostedShader* hosted = compiler::HostedShader::of(shader); hosted;
       hosted = hosted->displacement())
    compiler::addReads(hosted->code(), out);
  return out;
}

}  // namespace tomales

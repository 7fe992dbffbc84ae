// Finds the files that a shader reads while it runs, such as textures: their names stand in its text, are parameters,
// or are computed.
#include <dlfcn.h>

#include <algorithm>
#include <span>

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

/// Marks registers of texts until `step`, which is called with each instruction and a function that marks a register,
/// marks no more.
template <class Step>
void spread(const Code& code, std::vector<char>& marked, const Step& step) {
  for (bool changed = true; changed;) {
    changed = false;
    const auto mark = [&](int32_t r) {
      if (!isText(code, r) || marked[static_cast<size_t>(r)]) return;
      marked[static_cast<size_t>(r)] = 1;
      changed = true;
    };
    forEach(code.body, [&](const Instruction& i) { step(i, mark); });
  }
}

/// Returns for each register whether it may hold a text that is neither constant nor a parameter: computed, or told by
/// others.
std::vector<char> unknownTexts(const Code& code) {
  std::vector<char> out(code.registers.size(), 0);
  spread(code, out, [&](const Instruction& i, const auto& mark) {
    bool unknown = !handsOn(i.op);
    for (const int32_t r : i.in) unknown |= isText(code, r) && out[static_cast<size_t>(r)];
    if (unknown) forEachWrite(i, mark);
  });
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

/// Returns for each register whether its text may get into one of `files`.
std::vector<char> sourcesOf(const Code& code, const std::vector<int32_t>& files) {
  std::vector<char> out(code.registers.size(), 0);
  for (const int32_t file : files) out[static_cast<size_t>(file)] = 1;
  spread(code, out, [&](const Instruction& i, const auto& mark) {
    bool wanted = false;
    if (handsOn(i.op)) forEachWrite(i, [&](int32_t r) { wanted |= out[static_cast<size_t>(r)] != 0; });
    if (wanted) std::ranges::for_each(i.in, mark);
  });
  return out;
}

/// Returns the texts that a register has before the code runs.
std::span<const std::string> initialTexts(const Code& code, const Register& r) {
  if (r.origin == Origin::Constant) return r.texts;
  if (r.origin == Origin::Parameter) return code.parameters[static_cast<size_t>(r.index)].texts;
  return {};
}

void addReads(const Code& code, RslReads& out) {
  for (const Builtin* function : code.plugins)
    if (Dl_info plugin{}; dladdr(reinterpret_cast<const void*>(function->plugin), &plugin) != 0 && plugin.dli_fname)
      out.names.emplace_back(plugin.dli_fname);
  const std::vector<char> unknown = unknownTexts(code);
  std::vector<int32_t> files;
  forEach(code.body, [&](const Instruction& i) {
    if (const int32_t file = fileOf(code, i); file >= 0) files.push_back(file);
  });
  for (const int32_t file : files)
    if (unknown[static_cast<size_t>(file)]) out.isKnown = false;
  const std::vector<char> sources = sourcesOf(code, files);
  for (size_t r = 0; r < code.registers.size(); ++r)
    if (sources[r])
      for (const std::string& text : initialTexts(code, code.registers[r])) out.names.push_back(text);
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

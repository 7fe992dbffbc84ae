#include "reyes/rsl/tree.h"

#include <algorithm>

#include <fmt/format.h>

namespace tomales::compiler {
namespace {

constexpr const char* kShaderKinds[] = {"surface", "light", "displacement", "volume", "imager", "transformation"};
constexpr const char* kBases[] = {"void", "float", "color", "point", "vector", "normal", "matrix", "string"};

}  // namespace

const char* name(ShaderKind kind) { return kShaderKinds[static_cast<size_t>(kind)]; }

std::optional<ShaderKind> shaderKindNamed(std::string_view name) {
  for (size_t i = 0; i < std::size(kShaderKinds); ++i)
    if (name == kShaderKinds[i]) return static_cast<ShaderKind>(i);
  return std::nullopt;
}

const char* name(Base base) { return kBases[static_cast<size_t>(base)]; }

std::optional<Base> baseNamed(std::string_view name) {
  for (size_t i = 0; i < std::size(kBases); ++i)
    if (name == kBases[i]) return static_cast<Base>(i);
  return std::nullopt;
}

std::string name(const Type& type) {
  if (!type.isArray()) return name(type.base);
  return type.length == kOpenArray ? fmt::format("{}[]", name(type.base))
                                   : fmt::format("{}[{}]", name(type.base), type.length);
}

bool contains(const Stmt& s, std::initializer_list<StmtKind> kinds) {
  if (std::find(kinds.begin(), kinds.end(), s.kind) != kinds.end()) return true;
  if (s.kind == StmtKind::Define) return false;
  return std::any_of(s.body.begin(), s.body.end(), [&](const StmtPtr& part) { return contains(*part, kinds); });
}

}  // namespace tomales::compiler

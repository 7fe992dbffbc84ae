#include "reyes/rsl/tree.h"

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

}  // namespace tomales::compiler

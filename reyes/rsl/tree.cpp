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

const std::vector<std::string>& shaderKindNames() {
  static const std::vector<std::string> names(std::begin(kShaderKinds), std::end(kShaderKinds));
  return names;
}

const char* name(Base base) { return kBases[static_cast<size_t>(base)]; }

std::optional<Base> baseNamed(std::string_view name) {
  for (size_t i = 0; i < std::size(kBases); ++i)
    if (name == kBases[i]) return static_cast<Base>(i);
  return std::nullopt;
}

const std::vector<std::string>& typeNames() {
  static const std::vector<std::string> names(std::begin(kBases) + 1, std::end(kBases));
  return names;
}

std::string name(const Type& type) {
  if (!type.isArray()) return name(type.base);
  return type.length == kOpenArray ? fmt::format("{}[]", name(type.base))
                                   : fmt::format("{}[{}]", name(type.base), type.length);
}

std::optional<float> constantOf(const Expr& e) {
  if (e.kind == ExprKind::Number) return e.number;
  if (e.kind != ExprKind::Unary && e.kind != ExprKind::Binary) return {};
  const std::optional<float> a = constantOf(*e.args[0]);
  if (!a) return {};
  if (e.kind == ExprKind::Unary) return e.text == "+" ? a : e.text == "-" ? std::optional(-*a) : std::nullopt;
  const std::optional<float> b = constantOf(*e.args[1]);
  if (!b) return {};
  if (e.text == "+") return *a + *b;
  if (e.text == "-") return *a - *b;
  if (e.text == "*") return *a * *b;
  return e.text == "/" ? std::optional(*a / *b) : std::nullopt;
}

bool contains(const Stmt& s, std::initializer_list<StmtKind> kinds) {
  if (std::find(kinds.begin(), kinds.end(), s.kind) != kinds.end()) return true;
  if (s.kind == StmtKind::Define) return false;
  return std::any_of(s.body.begin(), s.body.end(), [&](const StmtPtr& part) { return contains(*part, kinds); });
}

}  // namespace tomales::compiler

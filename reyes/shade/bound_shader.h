// A shader with its parameters resolved: defaults, what RIB gave, and points moved from shader to current
// space.
#pragma once

#include "reyes/shader_api.h"
#include "reyes/state.h"

namespace tomales {

struct BoundShader {
  const TmShader* shader = nullptr;
  SourceLoc where;   ///< Of the request, or of the object that has none.
  std::string user;  ///< What it is bound for, in messages: an object or a light.
  mat4 currentFromShader{1.0f};
  std::vector<TmValue> values;  ///< In the order of TmShader::params; they point into the arrays below.

  bool can(TmCapability capability) const { return (shader->capabilities & capability) != 0; }
  const TmValue* find(std::string_view name) const;
  /// Of the output parameter of that name, in TmShader::params; -1: none.
  int output(std::string_view name, ValueType type) const;
  float number(std::string_view name, float fallback) const;
  vec3 color(std::string_view name, const vec3& fallback) const;
  std::string text(std::string_view name, const std::string& fallback) const;

  std::vector<std::vector<float>> floats;
  std::vector<std::string> strings;
};
using BoundShaderPtr = std::shared_ptr<const BoundShader>;

inline bool isOutput(const TmParamDecl& decl) { return (decl.type & TM_OUTPUT) != 0; }
inline bool isUniform(const TmParamDecl& decl) { return (decl.type & TM_UNIFORM) != 0; }
inline int32_t typeOf(const TmParamDecl& decl) { return TM_TYPE_OF(decl.type); }

using ParamNames = std::vector<std::string_view>;

/// `call` may be null: all defaults. Reports parameters that the shader does not have, except `hostParams`,
/// and values of another type or length than declared (parameter_values.h says what becomes of those).
BoundShaderPtr bindShader(const TmShader& shader, const ShaderCall* call, const SourceLoc& where,
                          const std::string& user, const mat4& currentFromShader, const ParamNames& hostParams,
                          Log& log);

/// Points, vectors and normals (`type`) through a matrix; other types are left alone.
vec3 transformAs(TmType type, const mat4& m, const vec3& v);

}  // namespace tomales

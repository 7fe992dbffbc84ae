// A shader with its parameters resolved: defaults, what RIB gave, and points moved from shader to current
// space.
#pragma once
#include "reyes/shader_api.h"
#include "reyes/shader_registry.h"
#include "reyes/state.h"

namespace tomales {

/// What a parameter with a role says (reyes/shade/roles.h).
struct RoleValue {
  TmRole role;
  const char* name;   ///< Of the parameter.
  bool declared;      ///< By the shader; else it is a standard parameter that the request gives.
  bool given;         ///< By the request; else it is the shader's default.
  vec3 number{0.0f};  ///< x alone, of a float.
  std::string text;   ///< Of a string.
};

struct BoundShader {
  const TmShader* shader = nullptr;
  SourceLoc where;   ///< Of the request, or of the object that has none.
  std::string user;  ///< What it is bound for, in messages: an object or a light.
  mat4 currentFromShader{1.0f};
  /// In the order of TmShader::params, and one more that no shader may read (TmGrid::params); they point into the
  /// arrays below.
  std::vector<TmValue> values;

  bool can(TmCapability capability) const { return (shader->capabilities & capability) != 0; }
  /// Of the output parameter of that name, in TmShader::params; -1: none.
  int output(std::string_view name, ValueType type) const;
  /// Likewise, of that role.
  int output(TmRole role) const;

  // What the host reads of a shader: by roles, never by names.
  std::vector<RoleValue> told;  ///< Of all parameters with a role but outputs; those that are given come first.
  const RoleValue* find(TmRole role) const;
  float number(TmRole role, float fallback) const;
  vec3 color(TmRole role, const vec3& fallback) const;
  /// The first that is not empty; else `fallback`.
  std::string text(TmRole role, const std::string& fallback) const;

  std::vector<std::vector<float>> floats;
  std::vector<std::string> strings;
};
using BoundShaderPtr = std::shared_ptr<const BoundShader>;

inline bool isOutput(const TmParamDecl& decl) { return (decl.type & TM_OUTPUT) != 0; }
inline bool isUniform(const TmParamDecl& decl) { return (decl.type & TM_UNIFORM) != 0; }
inline int32_t typeOf(const TmParamDecl& decl) { return TM_TYPE_OF(decl.type); }

/// `call` may be null: all defaults. Reports parameters that neither the shader has nor every shader of its kind
/// (standardParams()), and values of another type or length than declared (parameter_values.h says what becomes of
/// those).
BoundShaderPtr bindShader(const TmShader& shader, const ShaderCall* call, const SourceLoc& where,
                          const std::string& user, const mat4& currentFromShader, Log& log);

/// Points, vectors and normals (`type`) through a matrix; other types are left alone.
vec3 transformAs(TmType type, const mat4& m, const vec3& v);

}  // namespace tomales

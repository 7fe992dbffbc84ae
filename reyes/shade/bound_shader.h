// A shader with its parameters resolved from defaults and RIB, and with points transformed from shader to current
// space.
#pragma once
#include "reyes/shader_api.h"
#include "reyes/shader_registry.h"
#include "reyes/state.h"

namespace tomales {

/// The value of a parameter with a role (reyes/shade/roles.h).
struct RoleValue {
  TmRole role;
  const char* name;   ///< The parameter's name.
  bool declared;      ///< True if the shader declares it; false for a standard parameter that the request gives.
  bool given;         ///< True if the request gives it; false for the shader's default.
  vec3 number{0.0f};  ///< The value of a float is in x alone.
  std::string text;   ///< The value of a string.
};

struct BoundShader {
  const TmShader* shader = nullptr;
  SourceLoc where;   ///< The place of the request, or of an object without one.
  std::string user;  ///< The object or light that it is bound for, in messages.
  mat4 currentFromShader{1.0f};
  /// The values in the order of TmShader::params, followed by one that no shader may read (TmGrid::params). They point
  /// into the arrays below.
  std::vector<TmValue> values;

  bool can(TmCapability capability) const { return (shader->capabilities & static_cast<uint32_t>(capability)) != 0; }
  /// Returns the index in TmShader::params of the output parameter of that name, or -1.
  int output(std::string_view name, ValueType type) const;
  int outputNamed(std::string_view name) const;  ///< Of any type.
  /// Returns the index of the output parameter with that role, or -1.
  int output(TmRole role) const;

  // The host reads a shader's parameters by roles, never by names.
  /// The values of parameters with a role, without outputs and without defaults that the shader computes. Values that
  /// the request gives come first. Within each part the shader's own parameters come in the order of TmShader::params,
  /// then standard ones (standardParams()).
  std::vector<RoleValue> roleValues;
  const RoleValue* find(TmRole role) const;
  float number(TmRole role, float fallback) const;
  vec3 color(TmRole role, const vec3& fallback) const;
  /// Returns the first text of the role that is not empty, or `fallback`.
  std::string text(TmRole role, const std::string& fallback) const;

  std::vector<std::vector<float>> floats;
  std::vector<std::string> strings;
};
using BoundShaderPtr = std::shared_ptr<const BoundShader>;

inline bool isOutput(const TmParamDecl& decl) { return (decl.type & TM_OUTPUT) != 0; }
inline bool isUniform(const TmParamDecl& decl) { return (decl.type & TM_UNIFORM) != 0; }
inline int32_t typeOf(const TmParamDecl& decl) { return TM_TYPE_OF(decl.type); }

/// A null `call` gives all defaults. Reports parameters that are neither this shader's nor standard for its kind
/// (standardParams()), and values whose type or length differs from the declaration (parameter_values.h converts
/// those).
BoundShaderPtr bindShader(const TmShader& shader, const ShaderCall* call, const SourceLoc& where,
                          const std::string& user, const mat4& currentFromShader, Log& log);

/// Transforms points, vectors and normals (`type`) by a matrix; other types are left alone.
vec3 transformAs(TmType type, const mat4& m, const vec3& v);

}  // namespace tomales

#include "reyes/shade/bound_shader.h"

#include <fmt/format.h>

#include <glm/gtc/type_ptr.hpp>

#include "reyes/base/near_names.h"
#include "reyes/computed_default.h"
#include "reyes/rsl_host.h"
#include "reyes/shade/parameter_values.h"
#include "reyes/shade/roles.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

void toCurrent(int32_t type, const mat4& currentFromShader, std::vector<float>& v) {
  if (type == TM_MATRIX) {
    for (size_t k = 0; k + 16 <= v.size(); k += 16) {
      const mat4 m = currentFromShader * glm::make_mat4(&v[k]);
      std::copy_n(glm::value_ptr(m), 16, &v[k]);
    }
  } else if (floatsOf(type) == 3) {
    for (size_t k = 0; k + 3 <= v.size(); k += 3) {
      const vec3 p = transformAs(static_cast<TmType>(type), currentFromShader, {v[k], v[k + 1], v[k + 2]});
      v[k] = p.x;
      v[k + 1] = p.y;
      v[k + 2] = p.z;
    }
  }
}

}  // namespace

vec3 transformAs(TmType type, const mat4& m, const vec3& v) {
  switch (type) {
    case TM_POINT:
      return transformPoint(m, v);
    case TM_VECTOR:
      return transformVector(m, v);
    case TM_NORMAL:
      return glm::transpose(glm::inverse(mat3(m))) * v;
    default:
      return v;
  }
}

int BoundShader::output(std::string_view name, ValueType type) const {
  for (int i = 0; i < shader->paramCount; ++i)
    if (shader->params[i].name == name && isOutput(shader->params[i]) && accepts(typeOf(shader->params[i]), type))
      return i;
  return -1;
}

int BoundShader::outputNamed(std::string_view name) const {
  for (int i = 0; i < shader->paramCount; ++i)
    if (shader->params[i].name == name && isOutput(shader->params[i])) return i;
  return -1;
}

int BoundShader::output(TmRole role) const {
  for (int i = 0; i < shader->paramCount; ++i)
    if (isOutput(shader->params[i]) && roleOf(*shader, shader->params[i]) == role) return i;
  return -1;
}

const RoleValue* BoundShader::find(TmRole role) const {
  const auto it =
      std::find_if(roleValues.begin(), roleValues.end(), [&](const RoleValue& v) { return v.role == role; });
  return it == roleValues.end() ? nullptr : &*it;
}

float BoundShader::number(TmRole role, float fallback) const {
  const RoleValue* v = find(role);
  return v ? v->number.x : fallback;
}

vec3 BoundShader::color(TmRole role, const vec3& fallback) const {
  const RoleValue* v = find(role);
  return v ? v->number : fallback;
}

std::string BoundShader::text(TmRole role, const std::string& fallback) const {
  for (const RoleValue& v : roleValues)
    if (v.role == role && !v.text.empty()) return v.text;
  return fallback;
}

namespace {

RoleValue roleValue(TmRole role, const char* name, bool declared, bool given, const ParameterValue& value) {
  RoleValue out{role, name, declared, given, {}, {}};
  for (size_t k = 0; k < std::min<size_t>(value.floats.size(), 3); ++k)
    out.number[static_cast<int>(k)] = value.floats[k];
  if (!value.strings.empty()) out.text = value.strings.front();
  return out;
}

bool hasInput(const TmShader& shader, std::string_view name) {
  return std::any_of(shader.params, shader.params + shader.paramCount,
                     [&](const TmParamDecl& d) { return !isOutput(d) && d.name == name; });
}

/// Tells whether the shader computes this value itself: neither the scene nor a constant has given it.
bool isMark(const ParameterValue& v) {
  return v.strings.empty() ? !v.floats.empty() && std::isnan(v.floats[0]) : v.strings[0] == kComputedText;
}

/// Binds one shader; `warn` reports problems of a parameter.
class Binding {
 public:
  Binding(BoundShader& bound, const ShaderCall* call, Log& log) : bound_(bound), call_(call), log_(log) {}

  void bind() {
    const TmShader& shader = *bound_.shader;
    const size_t n = paramCount();
    bound_.floats.resize(n);
    bound_.strings.resize(n);
    bound_.values.resize(n + 1);
    bound_.values[n] = {{nullptr, nullptr, nullptr}, 1, 1, nullptr};  // null, so that a shader that reads it crashes
    for (size_t i = 0; i < n; ++i) bindDeclared(shader.params[i], i);
    for (Role& r : roles_) bindRole(r);
    if (!call_) return;
    const std::span<const TmParamDecl> standard = standardParams(static_cast<TmKind>(shader.kind));
    for (const TmParamDecl& decl : standard) bindStandard(decl);
    for (const Param& p : call_->params) warnOfUnknown(p, standard);
    std::stable_partition(bound_.roleValues.begin(), bound_.roleValues.end(),
                          [](const RoleValue& v) { return v.given; });
  }

 private:
  void warn(const char* code, std::string_view parameter, const std::string& problem) {
    log_.report(Severity::Warning, code, bound_.where,
                fmt::format("{}: shader \"{}\": {}", bound_.user, bound_.shader->name, problem),
                fmt::format("{} {}", bound_.shader->name, parameter));
  }

  ParameterValue valueOf(const TmParamDecl& decl, const Param* given) {
    ParameterValue out = parameterValue(decl, given);
    if (!out.remark.empty())
      warn("shader-parameter-type", decl.name, fmt::format("parameter \"{}\" {}", decl.name, out.remark));
    return out;
  }

  void bindDeclared(const TmParamDecl& decl, size_t i) {
    const Param* param = call_ ? findParam(call_->params, decl.name) : nullptr;
    TmValue& value = bound_.values[i];
    value = {{nullptr, nullptr, nullptr}, 0, std::max(1, decl.arrayLength), nullptr};
    if (isOutput(decl)) {
      if (param && !hasInput(*bound_.shader, decl.name))
        warn("shader-parameter-output", decl.name,
             fmt::format("\"{}\" is an output; what is given is ignored", decl.name));
      return;
    }
    ParameterValue parameter = valueOf(decl, param);
    if (const TmRole role = roleOf(*bound_.shader, decl); role != TM_ROLE_NONE)
      roles_.push_back({role, i, param != nullptr, parameter});
    if (typeOf(decl) == TM_STRING) {
      for (const std::string& s : parameter.strings) bound_.strings[i].append(s).push_back('\0');
      value.string = bound_.strings[i].c_str();
      return;
    }
    bound_.floats[i] = std::move(parameter.floats);
    toCurrent(typeOf(decl), bound_.currentFromShader, bound_.floats[i]);
    for (size_t k = 0; k < std::min<size_t>(bound_.floats[i].size(), 3); ++k) value.c[k] = bound_.floats[i].data() + k;
  }

  struct Role {
    TmRole role;
    size_t index;
    bool given;
    ParameterValue value;
  };

  /// Notes a value with a role. A value that the shader computes is known only if it is always the same.
  void bindRole(Role& r) {
    const TmShader& shader = *bound_.shader;
    const TmParamDecl& decl = shader.params[r.index];
    const auto index = static_cast<int32_t>(r.index);
    if (isMark(r.value) && rslComputesDefault(shader, index)) {
      std::optional<RslValue> fixed = rslFixedValue(shader, index, bound_.values.data());
      if (fixed) r.value = {std::move(fixed->floats), std::move(fixed->texts), ""};
    }
    if (!isMark(r.value))
      bound_.roleValues.push_back(roleValue(r.role, decl.name, true, r.given, r.value));
    else if (bound_.output(r.role) < 0)  // otherwise it is read point by point
      warn("light-value", decl.name,
           fmt::format("the shader computes the default of \"{}\" when it runs, which the renderer cannot know; it "
                       "takes its own default",
                       decl.name));
  }

  void bindStandard(const TmParamDecl& decl) {
    const Param* given = findParam(call_->params, decl.name);
    if (given && !declares(decl.name))
      bound_.roleValues.push_back(
          roleValue(static_cast<TmRole>(decl.role), decl.name, false, true, valueOf(decl, given)));
  }

  void warnOfUnknown(const Param& p, std::span<const TmParamDecl> standard) {
    const bool known = declares(p.name) || std::any_of(standard.begin(), standard.end(),
                                                       [&](const TmParamDecl& d) { return d.name == p.name; });
    if (known || p.storage == Storage::Constant)
      return;  // constants are those of a primitive, which no shader need have
    std::vector<std::string> names;
    for (const std::span<const TmParamDecl> list : {std::span(bound_.shader->params, paramCount()), standard})
      for (const TmParamDecl& d : list) names.emplace_back(d.name);
    warn("shader-parameter-unknown", p.name,
         fmt::format("has no parameter \"{}\"; it is ignored{}", p.name, didYouMean(p.name, names)));
  }

  size_t paramCount() const { return static_cast<size_t>(bound_.shader->paramCount); }

  bool declares(std::string_view name) const {
    const TmShader& shader = *bound_.shader;
    return std::any_of(shader.params, shader.params + shader.paramCount,
                       [&](const TmParamDecl& d) { return d.name == name; });
  }

  BoundShader& bound_;
  const ShaderCall* call_;
  Log& log_;
  std::vector<Role> roles_;  ///< Those of the shader's own parameters, in their order.
};

}  // namespace

BoundShaderPtr bindShader(const TmShader& shader, const ShaderCall* call, const SourceLoc& where,
                          const std::string& user, const mat4& currentFromShader, Log& log) {
  auto bound = std::make_shared<BoundShader>();
  bound->shader = &shader;
  bound->where = where;
  bound->user = user;
  bound->currentFromShader = currentFromShader;
  Binding(*bound, call, log).bind();
  return bound;
}

}  // namespace tomales

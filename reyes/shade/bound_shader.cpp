#include "reyes/shade/bound_shader.h"

#include <fmt/format.h>

#include <glm/gtc/type_ptr.hpp>

#include "reyes/shade/parameter_values.h"

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
      v[k] = p.x, v[k + 1] = p.y, v[k + 2] = p.z;
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

const TmValue* BoundShader::find(std::string_view name) const {
  for (size_t i = 0; i < values.size(); ++i)
    if (shader->params[i].name == name) return &values[i];
  return nullptr;
}

int BoundShader::output(std::string_view name, ValueType type) const {
  for (int i = 0; i < shader->paramCount; ++i)
    if (shader->params[i].name == name && isOutput(shader->params[i]) && accepts(typeOf(shader->params[i]), type))
      return i;
  return -1;
}

float BoundShader::number(std::string_view name, float fallback) const {
  const TmValue* v = find(name);
  return v && v->c[0] ? v->c[0][0] : fallback;
}

vec3 BoundShader::color(std::string_view name, const vec3& fallback) const {
  const TmValue* v = find(name);
  return v && v->c[2] ? vec3(v->c[0][0], v->c[1][0], v->c[2][0]) : fallback;
}

std::string BoundShader::text(std::string_view name, const std::string& fallback) const {
  const TmValue* v = find(name);
  return v && v->string ? v->string : fallback;
}

BoundShaderPtr bindShader(const TmShader& shader, const ShaderCall* call, const SourceLoc& where,
                          const std::string& user, const mat4& currentFromShader, const ParamNames& hostParams,
                          Log& log) {
  auto bound = std::make_shared<BoundShader>();
  bound->shader = &shader, bound->where = where, bound->user = user, bound->currentFromShader = currentFromShader;
  const size_t n = static_cast<size_t>(shader.paramCount);
  bound->floats.resize(n), bound->strings.resize(n), bound->values.resize(n);

  const auto warn = [&](const char* code, std::string_view parameter, const std::string& problem) {
    log.report(Severity::Warning, fmt::format("{}-{}-{}", code, shader.name, parameter), where,
               fmt::format("{}: shader \"{}\": {}", user, shader.name, problem));
  };
  for (size_t i = 0; i < n; ++i) {
    const TmParamDecl& decl = shader.params[i];
    const Param* param = call ? findParam(call->params, decl.name) : nullptr;
    TmValue& value = bound->values[i];
    value = {{nullptr, nullptr, nullptr}, 0, std::max(1, decl.arrayLength), nullptr};
    if (isOutput(decl)) {
      const bool isInputToo = std::any_of(shader.params, shader.params + n, [&](const TmParamDecl& d) {
        return !isOutput(d) && std::string_view(d.name) == decl.name;
      });
      if (param && !isInputToo)
        warn("shader-parameter-output", decl.name,
             fmt::format("\"{}\" is an output; what is given is ignored", decl.name));
      continue;
    }
    ParameterValue parameter = parameterValue(decl, param);
    if (!parameter.remark.empty())
      warn("shader-parameter-type", decl.name, fmt::format("parameter \"{}\" {}", decl.name, parameter.remark));
    if (typeOf(decl) == TM_STRING) {
      for (const std::string& s : parameter.strings) bound->strings[i].append(s).push_back('\0');
      value.string = bound->strings[i].c_str();
      continue;
    }
    bound->floats[i] = std::move(parameter.floats);
    toCurrent(typeOf(decl), currentFromShader, bound->floats[i]);
    for (size_t k = 0; k < std::min<size_t>(bound->floats[i].size(), 3); ++k) value.c[k] = bound->floats[i].data() + k;
  }
  if (call)
    for (const Param& p : call->params)  // constants are those of a primitive, which no shader need have
      if (p.storage != Storage::Constant && !bound->find(p.name) &&
          std::find(hostParams.begin(), hostParams.end(), p.name) == hostParams.end())
        warn("shader-parameter-unknown", p.name, fmt::format("has no parameter \"{}\"; it is ignored", p.name));
  return bound;
}

}  // namespace tomales

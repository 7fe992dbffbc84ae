#include "reyes/shade/bound_shader.h"

#include <fmt/format.h>

#include <glm/gtc/type_ptr.hpp>

namespace tomales {
namespace {

int floatsOf(int32_t type) {
  switch (type) {
    case TM_COLOR:
    case TM_POINT:
    case TM_VECTOR:
    case TM_NORMAL:
      return 3;
    case TM_MATRIX:
      return 16;
    case TM_STRING:
      return 0;
    default:
      return 1;
  }
}

bool accepts(int32_t declared, ValueType given) {
  switch (declared) {
    case TM_FLOAT:
      return given == ValueType::Float || given == ValueType::Integer;
    case TM_COLOR:
      return given == ValueType::Color;
    case TM_STRING:
      return given == ValueType::String;
    case TM_MATRIX:
      return given == ValueType::Matrix;
    default:
      return given == ValueType::Point || given == ValueType::Vector || given == ValueType::Normal;
  }
}

size_t given(const Param& p) {
  return p.type == ValueType::String ? p.strings.size() : std::max(p.floats.size(), p.ints.size());
}

std::vector<float> valuesOf(const TmParamDecl& decl, const Param* param, size_t count) {
  std::vector<float> out(count, 0.0f);
  if (param && !param->floats.empty())
    std::copy_n(param->floats.begin(), count, out.begin());
  else if (param)
    std::transform(param->ints.begin(), param->ints.begin() + static_cast<std::ptrdiff_t>(count), out.begin(),
                   [](int i) { return static_cast<float>(i); });
  else if (decl.floats)
    std::copy_n(decl.floats, count, out.begin());
  return out;
}

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
    if (shader->params[i].name == name && isOutput(shader->params[i]) &&
        accepts(shader->params[i].type & ~TM_OUTPUT, type))
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
                          const std::string& user, const mat4& currentFromShader,
                          const ParamNames& hostParams, Log& log) {
  auto bound = std::make_shared<BoundShader>();
  bound->shader = &shader, bound->where = where, bound->user = user,
  bound->currentFromShader = currentFromShader;
  const size_t n = static_cast<size_t>(shader.paramCount);
  bound->floats.resize(n), bound->strings.resize(n), bound->values.resize(n);

  const auto warn = [&](const char* code, const std::string& problem) {
    log.report(Severity::Warning, fmt::format("{}-{}", code, shader.name), where,
               fmt::format("{}: shader \"{}\": {}", user, shader.name, problem));
  };
  for (size_t i = 0; i < n; ++i) {
    const TmParamDecl& decl = shader.params[i];
    const size_t width = static_cast<size_t>(floatsOf(decl.type)) * static_cast<size_t>(decl.arrayLength);
    const Param* param = call ? findParam(call->params, decl.name) : nullptr;
    if (param && isOutput(decl)) {
      warn("shader-parameter-output", fmt::format("\"{}\" is an output; what is given is ignored", decl.name));
      param = nullptr;
    }
    const size_t needed = decl.type == TM_STRING ? 1 : width;
    if (param && (!accepts(decl.type, param->type) || given(*param) < needed)) {
      warn("shader-parameter-type", fmt::format("parameter \"{}\" has a value of the wrong type or length; "
                                                "its default is used",
                                                decl.name));
      param = nullptr;
    }
    TmValue& value = bound->values[i];
    value = {{nullptr, nullptr, nullptr}, 0, decl.arrayLength, nullptr};
    if (isOutput(decl)) continue;
    if (decl.type == TM_STRING) {
      const char* fallback = decl.strings && decl.strings[0] ? decl.strings[0] : "";
      bound->strings[i] = param ? param->strings[0] : fallback;
      value.string = bound->strings[i].c_str();
      continue;
    }
    bound->floats[i] = valuesOf(decl, param, width);
    toCurrent(decl.type, currentFromShader, bound->floats[i]);
    for (size_t k = 0; k < std::min<size_t>(width, 3); ++k) value.c[k] = bound->floats[i].data() + k;
  }
  if (call)
    for (const Param& p : call->params)
      if (!bound->find(p.name) && std::find(hostParams.begin(), hostParams.end(), p.name) == hostParams.end())
        warn("shader-parameter-unknown", fmt::format("has no parameter \"{}\"; it is ignored", p.name));
  return bound;
}

}  // namespace tomales

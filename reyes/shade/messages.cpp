// RSL's message passing: values of other shaders, of attributes, of options and of the renderer.
#include <string_view>

#include "reyes/attribute_table.h"
#include "reyes/rsl_host.h"
#include "reyes/shade/parameter_values.h"
#include "reyes/shade/primary.h"
#include "reyes/shade/remote_batch.h"
#include "reyes/shade/services.h"

namespace tomales {
namespace {

// The functions below return 1 and fill in the type and the value if there is such a value, else 0.

int32_t answerParam(Batch& batch, const Param& p, int32_t* type, TmValue* out) {
  std::vector<float> numbers = p.floats;
  numbers.insert(numbers.end(), p.ints.begin(), p.ints.end());
  batch.answer(numbers, wordOf(&p), tmTypeOf(p.type), *type, *out);
  return 1;
}

int32_t answerNumbers(Batch& batch, const std::vector<float>& numbers, int32_t* type, TmValue* out) {
  batch.answer(numbers, "", TM_FLOAT, *type, *out);
  return 1;
}

/// Finds a parameter of a shader among the values of one run. An output has none unless the shader has ended: what it
/// begins with, a further parameter of that name in shaders of RSL, is no answer.
int32_t answerShaderParameter(const BoundShader* shader, const TmValue* values, std::string_view name, int32_t* type,
                              TmValue* out, bool ended = false) {
  if (!shader) return 0;
  if (name == "__shadername") {
    *type = TM_STRING;
    *out = {{nullptr, nullptr, nullptr}, 0, 1, shader->shader->name};
    return 1;
  }
  for (int i = 0; i < shader->shader->paramCount; ++i) {
    const TmParamDecl& decl = shader->shader->params[i];
    if (decl.name != name) continue;
    if ((isOutput(decl) && !(ended && values[i].c[0])) || (decl.type & kBeginsOutput) != 0) return 0;
    *type = TM_TYPE_OF(decl.type);
    *out = values[i];
    return 1;
  }
  return 0;
}

int32_t answerShaderParameter(const BoundShaderPtr& shader, std::string_view name, int32_t* type, TmValue* out) {
  return shader ? answerShaderParameter(shader.get(), shader->values.data(), name, type, out) : 0;
}

/// Finds what the displacement shader has computed at the points. It has run at those that the camera sees alone.
int32_t answerDisplaced(const Batch& batch, std::string_view name, int32_t* type, TmValue* out) {
  // Points in the air of a Volume have no variables.
  if (batch.context.kind != RayKind::Camera || !batch.points ||
      batch.points->primvarFloats() < batch.group.primvarFloats)
    return 0;
  for (const Override& o : batch.group.displacementOutputs) {
    const TmParamDecl& decl = batch.group.displacement->shader->params[o.param];
    if (decl.name != name) continue;
    *type = TM_TYPE_OF(decl.type);
    *out = {{}, 1, 1, nullptr};
    for (int k = 0; k < o.width; ++k) out->c[k] = batch.primvar(o.primvarOffset + k);
    return 1;
  }
  return 0;
}

int32_t answerAttribute(Batch& batch, std::string_view name, int32_t* type, TmValue* out) {
  const Attributes& a = *batch.group.group->attributes;
  if (name.starts_with("Ri:")) name.remove_prefix(3);
  const NamedAttribute* row = findNamedAttribute(name);
  if (row && row->get) return answerParam(batch, row->get(a), type, out);
  const Param* param = findParam(a.user, std::string(name));
  return param ? answerParam(batch, *param, type, out) : 0;
}

int32_t answerOption(Batch& batch, std::string_view name, int32_t* type, TmValue* out) {
  const Options& o = batch.scene.scene.options;
  if (name.starts_with("Ri:")) name.remove_prefix(3);
  const auto numbers = [&](const std::vector<float>& n) { return answerNumbers(batch, n, type, out); };
  if (name == "Format")
    return numbers({static_cast<float>(o.xResolution), static_cast<float>(o.yResolution), o.pixelAspect});
  if (name == "Shutter") return numbers({o.shutterOpen, o.shutterClose});
  if (name == "Clipping") return numbers({o.nearClip, o.farClip});
  if (name == "CropWindow") return numbers({o.cropWindow.begin(), o.cropWindow.end()});
  if (name == "PixelSamples") return numbers({static_cast<float>(o.xSamples), static_cast<float>(o.ySamples)});
  if (name == "Frame") return numbers({static_cast<float>(o.frame)});
  const Param* param = findParam(o.user, std::string(name));
  return param ? answerParam(batch, *param, type, out) : 0;
}

int32_t answerRenderer(Batch& batch, std::string_view name, int32_t* type, TmValue* out) {
  if (name == "renderer") {
    batch.answer({}, "Tomales", TM_STRING, *type, *out);
    return 1;
  }
  if (name == "versionstring") {
    batch.answer({}, TOMALES_VERSION, TM_STRING, *type, *out);
    return 1;
  }
  if (name != "version") return 0;
  std::vector<float> version(4, 0.0f);
  const std::string_view text = TOMALES_VERSION;
  for (size_t part = 0, begin = 0; part < 4 && begin < text.size(); ++part) {
    for (; begin < text.size() && text[begin] != '.'; ++begin)
      version[part] = 10 * version[part] + static_cast<float>(text[begin] - '0');
    ++begin;
  }
  return answerNumbers(batch, version, type, out);
}

/// Finds a parameter of the incident or opposite volume. Which volume that is depends on the side that is seen, point
/// by point; strings and arrays are those of the first point.
int32_t answerVolume(Batch& batch, const TmGrid* g, bool incident, std::string_view name, int32_t* type, TmValue* out) {
  TmValue side[2];
  int32_t types[2] = {-1, -1};
  const bool has[2] = {answerShaderParameter(batch.group.exterior, name, &types[0], &side[0]) != 0,
                       answerShaderParameter(batch.group.interior, name, &types[1], &side[1]) != 0};
  const auto inside = [&](int i) { return (dot(get(g->I, i), get(g->Ng, i)) > 0) == incident; };
  int first = 0;
  while (first + 1 < g->count && !g->active[first]) ++first;
  const int chosen = inside(first);
  if (!has[chosen]) return 0;
  *type = types[chosen];
  *out = side[chosen];
  if (!has[!chosen] || types[0] != types[1] || !side[0].c[0] || side[0].length != 1 || *type == TM_MATRIX) return 1;
  for (int k = 0; k < 3 && side[0].c[k]; ++k) {
    float* values = batch.arena.floats(g->count);
    for (int i = 0; i < g->count; ++i) values[i] = side[inside(i)].c[k][0];
    out->c[k] = values;
  }
  out->step = 1;
  return 1;
}

int32_t ask(void* host, const TmGrid* g, int32_t whom, int32_t light, const char* name, int32_t* type, TmValue* out) {
  Batch& batch = batchOf(host);
  const BoundGroup& group = batch.group;
  const auto kindIs = [&](TmKind kind) { return batch.own && batch.own->shader->kind == kind; };
  switch (whom) {
    case TM_OF_SURFACE:
      return kindIs(TM_SURFACE) ? answerShaderParameter(batch.own, batch.tm.params, name, type, out)
                                : answerShaderParameter(group.surface, name, type, out);
    case TM_OF_DISPLACEMENT:
      if (kindIs(TM_DISPLACEMENT)) return answerShaderParameter(batch.own, batch.tm.params, name, type, out);
      return answerDisplaced(batch, name, type, out) || answerShaderParameter(group.displacement, name, type, out);
    case TM_OF_ATMOSPHERE:
      return answerShaderParameter(group.atmosphere, name, type, out);
    case TM_OF_INCIDENT:
    case TM_OF_OPPOSITE:
      return answerVolume(batch, g, whom == TM_OF_INCIDENT, name, type, out);
    case TM_OF_LIGHT: {
      if (light < 0) return answerShaderParameter(batch.running, g->params, name, type, out);
      const LightSample* sample = lightNumbered(batch, light);
      return sample && sample->params
                 ? answerShaderParameter(sample->light->bound.get(), sample->params, name, type, out, true)
                 : 0;
    }
    case TM_OF_ATTRIBUTES:
      return answerAttribute(batch, name, type, out);
    case TM_OF_OPTIONS:
      return answerOption(batch, name, type, out);
    case TM_OF_RENDERER:
      return answerRenderer(batch, name, type, out);
    default:
      return 0;
  }
}

}  // namespace

void addMessageServices(TmServices& services) { services.ask = ask; }

}  // namespace tomales

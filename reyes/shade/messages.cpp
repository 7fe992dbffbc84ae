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

/// Returns component c of element e at point i.
float numberAt(const TmValue& v, int width, int e, int c, int i) {
  return width == 3 ? v.c[c][e * 3 + i * v.step] : v.c[0][e * width + c + i * v.step];
}

/// Makes room for an array or matrix at each of `points` points, all numbers of a point in a row.
float* openEach(Batch& batch, int points, int width, TmValue& value) {
  value.step = value.length * width;
  float* const to = batch.arena.floats(points * value.step);
  for (int c = 0; c < 3; ++c) value.c[c] = c < (width == 3 ? 3 : 1) ? to + c : nullptr;
  return to;
}

/// Lays an array or matrix that varies, of which each number is a row of `points`, out point by point.
void interleave(Batch& batch, int points, int width, TmValue& value) {
  const float* const from = value.c[0];
  float* const to = openEach(batch, points, width, value);
  for (int k = 0; k < value.step; ++k)
    for (int i = 0; i < points; ++i) to[i * value.step + k] = from[static_cast<ptrdiff_t>(k) * points + i];
}

/// Answers with what a shader of RSL has computed as a default.
int32_t answerComputed(Batch& batch, const TmParamDecl& decl, const RslValue& value, const TmGrid& g, int32_t* type,
                       TmValue* out) {
  const auto own = static_cast<TmType>(TM_TYPE_OF(decl.type));
  std::string texts;
  for (const std::string& text : value.texts) texts.append(text).push_back('\0');
  batch.answer(value.floats, texts, own, *type, *out);
  out->length = std::max(1, decl.arrayLength);
  if (!value.varies) return 1;
  if (out->length > 1 || own == TM_MATRIX) {
    interleave(batch, g.padded, floatsOf(own), *out);
    return 1;
  }
  const auto width = static_cast<size_t>(floatsOf(own));
  for (size_t k = 1; k < width; ++k) out->c[k] = out->c[0] + k * (value.floats.size() / width);
  out->step = 1;
  return 1;
}

/// Finds a parameter of a shader among the values of one run, the `params` of a grid. An output has no value before the
/// shader has ended. Its initial value, a further parameter of that name in shaders of RSL, is an answer if the shader
/// never assigns the output.
int32_t answerShaderParameter(Batch& batch, const BoundShader* shader, const TmGrid& g, std::string_view name,
                              int32_t* type, TmValue* out, bool ended = false) {
  if (!shader) return 0;
  const TmValue* const values = g.params;
  if (name == "__shadername") {
    *type = TM_STRING;
    *out = {{nullptr, nullptr, nullptr}, 0, 1, shader->shader->name};
    return 1;
  }
  for (int i = 0; i < shader->shader->paramCount; ++i) {
    const TmParamDecl& decl = shader->shader->params[i];
    if (decl.name != name) continue;
    if (isOutput(decl) && !(ended && values[i].c[0])) continue;
    if ((decl.type & kBeginsOutput) != 0) return 0;
    if (!isOutput(decl) && rslComputesDefault(*shader->shader, i)) {
      const std::optional<RslValue> value = batch.computed(*shader, i, g);
      return value ? answerComputed(batch, decl, *value, g, type, out) : 0;
    }
    *type = TM_TYPE_OF(decl.type);
    *out = values[i];
    if (out->step != 0 && (out->length > 1 || *type == TM_MATRIX)) interleave(batch, g.padded, floatsOf(*type), *out);
    return 1;
  }
  return 0;
}

/// Finds a parameter of another shader of the group, as it is at the points of the batch.
int32_t answerOther(Batch& batch, const BoundShaderPtr& shader, std::string_view name, int32_t* type, TmValue* out) {
  if (!shader) return 0;
  TmGrid g = batch.tm;
  g.params = batch.valuesOf(*shader).data();
  return answerShaderParameter(batch, shader.get(), g, name, type, out);
}

/// Finds an output of the displacement shader at the points. Only points that the camera sees have such values.
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

/// Finds an output of the surface that has run at the points before the atmosphere does. Neighbours have those of their
/// points.
int32_t answerSurfaceOutput(Batch& batch, std::string_view name, int32_t* type, TmValue* out) {
  const int n = batch.points ? batch.points->count() : 0;
  for (const Override& o : batch.group.toldToAir) {
    const TmParamDecl& decl = batch.group.surface->shader->params[o.param];
    if (decl.name != name || batch.ofSurface->variables.size() < static_cast<size_t>(o.primvarOffset + o.width))
      continue;
    *type = TM_TYPE_OF(decl.type);
    *out = {{}, 1, 1, nullptr};
    for (int k = 0; k < o.width; ++k) {
      const AlignedVector<float>& from = batch.ofSurface->variables[static_cast<size_t>(o.primvarOffset + k)];
      float* const to = batch.arena.floats(batch.tm.count);
      for (int i = 0; i < batch.tm.count; ++i) to[i] = from[static_cast<size_t>(i % n)];
      out->c[k] = to;
    }
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
  const Camera& camera = batch.scene.camera;
  if (name == "DeviceResolution")
    return numbers({static_cast<float>(camera.columns()), static_cast<float>(camera.rows()), o.pixelAspect});
  if (name == "FrameAspectRatio") return numbers({camera.frameAspect()});
  if (name == "DepthOfField") return numbers({o.fStop, o.focalLength, o.focalDistance});
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
/// by point; strings are those of the first point, and so are values that the two volumes tell in different types.
int32_t answerVolume(Batch& batch, const TmGrid* g, bool incident, std::string_view name, int32_t* type, TmValue* out) {
  TmValue side[2];
  int32_t types[2] = {};
  const bool has[2] = {answerOther(batch, batch.group.exterior, name, &types[0], &side[0]) != 0,
                       answerOther(batch, batch.group.interior, name, &types[1], &side[1]) != 0};
  const auto inside = [&](int i) { return (dot(get(g->I, i), get(g->Ng, i)) > 0) == incident; };
  int first = 0;
  while (first + 1 < g->count && !g->active[first]) ++first;
  const int chosen = inside(first);
  if (!has[chosen]) return 0;
  *type = types[chosen];
  *out = side[chosen];
  const bool several = has[!chosen] && types[0] == types[1] && side[0].c[0] && side[0].length == side[1].length;
  if (!several) return 1;
  const int width = floatsOf(*type);
  float* const to = openEach(batch, g->count, width, *out);
  for (int i = 0; i < g->count; ++i)
    for (int k = 0; k < out->step; ++k)
      to[i * out->step + k] = numberAt(side[inside(i)], width, k / width, k % width, i);
  return 1;
}

int32_t ask(void* host, const TmGrid* g, int32_t whom, int32_t light, const char* name, int32_t* type, TmValue* out) {
  Batch& batch = batchOf(host);
  const BoundGroup& group = batch.group;
  const auto kindIs = [&](TmKind kind) { return batch.own && batch.own->shader->kind == kind; };
  switch (whom) {
    case TM_OF_SURFACE:
      if (batch.ofSurface && answerSurfaceOutput(batch, name, type, out)) return 1;
      return kindIs(TM_SURFACE) ? answerShaderParameter(batch, batch.own, batch.tm, name, type, out)
                                : answerOther(batch, group.surface, name, type, out);
    case TM_OF_DISPLACEMENT:
      if (kindIs(TM_DISPLACEMENT)) return answerShaderParameter(batch, batch.own, batch.tm, name, type, out);
      return answerDisplaced(batch, name, type, out) || answerOther(batch, group.displacement, name, type, out);
    case TM_OF_ATMOSPHERE:
      return answerOther(batch, group.atmosphere, name, type, out);
    case TM_OF_INCIDENT:
    case TM_OF_OPPOSITE:
      return answerVolume(batch, g, whom == TM_OF_INCIDENT, name, type, out);
    case TM_OF_LIGHT: {
      if (light < 0) return answerShaderParameter(batch, batch.running, *g, name, type, out);
      const LightSample* sample = lightNumbered(batch, light);
      if (!sample || !sample->params) return 0;
      TmGrid lit = *g;
      lit.params = sample->params;
      lit.Pl = sample->Pl;
      lit.Nl = sample->Nl;
      return answerShaderParameter(batch, sample->light->bound.get(), lit, name, type, out, true);
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

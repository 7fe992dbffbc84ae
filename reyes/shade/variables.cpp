#include "reyes/shade/variables.h"

#include "reyes/shade/batch.h"

namespace tomales {
namespace {

using From = VariableSource;

void find(const Variable& wanted, const BoundGroup& group, BoundVariable& out) {
  if (const int output = group.surface->output(wanted.source, wanted.type); output >= 0) {
    out.from = From::Output;
    out.index = output;
    return;
  }
  if (wanted.source.starts_with(kLightGroup) && out.width == 3) {
    out.from = From::LightGroup;
    out.lights = wanted.source.substr(kLightGroup.size());
    return;
  }
  const SurfaceVariable* known = surfaceVariable(wanted.source);
  if (known && known->kind == ChannelKind::Variable && floatsPerValue(known->type) == out.width) {
    out.from = known->source;
    out.index = known->channel;
    return;
  }
  int offset = kFixedChannels;
  for (const Primvar& p : group.group->primvars) {
    if (p.name == wanted.source && p.width == out.width) {
      out.from = From::Channel;
      out.index = offset;
    }
    offset += p.width;
  }
}

/// Returns the arrays for the triple; the variable must be three floats wide.
TmVec3 destination(const BoundVariable& v, ShadedPoints& out, int begin) {
  const auto array = [&](int k) { return out.variables[static_cast<size_t>(v.first + k)].data() + begin; };
  return {array(0), array(1), array(2)};
}

void copyChannel(const BoundVariable& v, const Batch& batch, ShadedPoints& out, int begin) {
  for (int k = 0; k < v.width; ++k)
    std::copy_n(batch.points->channel(v.index + k), batch.points->count(),
                out.variables[static_cast<size_t>(v.first + k)].begin() + begin);
}

/// Runs the shader under some of the lights alone.
class LightGroups {
 public:
  LightGroups(Batch& batch, const BoundShader& shader) : batch_(batch), shader_(shader) {}

  void store(const std::string& group, TmVec3 to) {
    if (!unlit_.x) unlit_ = run("");
    const bool rest = group.empty();
    const TmVec3 lit = rest ? unlit_ : run(group);
    for (int i = 0; i < batch_.points->count(); ++i) set(to, i, get(lit, i) - (rest ? vec3(0.0f) : get(unlit_, i)));
  }

 private:
  TmVec3 run(const std::string& group) {
    const int n = batch_.tm.count;
    TmGrid g = batch_.tm;
    const auto paramCount = static_cast<size_t>(shader_.shader->paramCount);
    std::vector<TmValue> params(g.params, g.params + paramCount + 1);
    for (size_t i = 0; i < paramCount; ++i)
      if (isOutput(shader_.shader->params[i])) params[i].step = 0;
    g.params = params.data();
    g.Ci = batch_.arena.vec3(n);
    g.Oi = batch_.arena.vec3(n);
    batch_.lights.restrictTo(&group);
    if (!batch_.run(shader_, g)) g.Ci = batch_.arena.vec3(n);
    batch_.lights.restrictTo(nullptr);
    return g.Ci;
  }

  Batch& batch_;
  const BoundShader& shader_;
  TmVec3 unlit_{};
};

}  // namespace

std::vector<BoundVariable> bindVariables(const FrameOutput& output, const BoundGroup& group) {
  std::vector<BoundVariable> out;
  for (const Variable& wanted : output.variables) {
    BoundVariable v;
    v.first = wanted.first;
    v.width = floatsPerValue(wanted.type);
    v.fill = wanted.fill;
    v.composited = wanted.type == ValueType::Color;
    find(wanted, group, v);
    out.push_back(std::move(v));
  }
  return out;
}

std::vector<BoundVariable> bindOutputs(const std::vector<RayOutput>& told, const BoundShader& shader) {
  constexpr std::string_view kSurface = "surface:";
  std::vector<BoundVariable> out;
  int first = 0;
  for (const RayOutput& o : told) {
    BoundVariable v;
    v.first = first;
    v.width = o.floats;
    v.fill = std::numeric_limits<float>::quiet_NaN();
    first += o.floats;
    for (const ValueType type : {ValueType::Float, ValueType::Color, ValueType::Vector}) {
      if (!o.name.starts_with(kSurface) || floatsPerValue(type) != o.floats) continue;
      const int index = shader.output(std::string_view(o.name).substr(kSurface.size()), type);
      if (index >= 0) {
        v.from = From::Output;
        v.index = index;
        v.fill = 0;
      }
    }
    out.push_back(std::move(v));
  }
  return out;
}

void allocateVariables(const std::vector<BoundVariable>& variables, int count, ShadedPoints& out) {
  out.variables.clear();
  for (const BoundVariable& v : variables)
    for (int k = 0; k < v.width; ++k) out.variables.emplace_back(static_cast<size_t>(padded(count)), v.fill);
}

void storeVariables(const std::vector<BoundVariable>& variables, Batch& batch, const BoundShader& shader,
                    ShadedPoints& out, int begin) {
  LightGroups groups(batch, shader);
  for (const BoundVariable& v : variables) {
    if (v.from == From::Nothing) continue;
    const int n = batch.points->count();
    const auto each = [&](const auto& value) {
      const TmVec3 to = destination(v, out, begin);
      for (int i = 0; i < n; ++i) set(to, i, value(i));
    };
    if (v.from == From::Channel) copyChannel(v, batch, out, begin);
    // Colours that are composited are premultiplied.
    if (v.from == From::Channel && v.composited)
      each([&](int i) { return get(destination(v, out, begin), i) * get(batch.tm.Oi, i); });
    if (v.from == From::Color) each([&](int i) { return get(batch.tm.Cs, i) * get(batch.tm.Oi, i); });
    if (v.from == From::Opacity) each([&](int i) { return get(batch.tm.Oi, i); });
    if (v.from == From::Normal) each([&](int i) { return normalizeOr(batch.points->facingNormal(i), vec3(0.0f)); });
    if (v.from == From::LightGroup) groups.store(v.lights, destination(v, out, begin));
    for (int k = 0; k < v.width; ++k)
      for (int i = begin; i < begin + n; ++i) {
        float& value = out.variables[static_cast<size_t>(v.first + k)][static_cast<size_t>(i)];
        if (!std::isfinite(value)) value = 0;
      }
  }
}

}  // namespace tomales

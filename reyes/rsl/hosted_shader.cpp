#include "reyes/rsl/hosted_shader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reyes/rsl/machine/machine.h"
#include "reyes/rsl/passes/passes.h"
#include "reyes/rsl/passes/walk.h"
#include "reyes/rsl_host.h"

namespace tomales::compiler {
namespace {

TmKind kindOf(ShaderKind kind) {
  switch (kind) {
    case ShaderKind::Surface:
      return TM_SURFACE;
    case ShaderKind::Light:
      return TM_LIGHT;
    case ShaderKind::Volume:
      return TM_VOLUME;
    case ShaderKind::Imager:
      return TM_IMAGER;
    default:
      return TM_DISPLACEMENT;
  }
}

int32_t typeOf(const Parameter& p) {
  static constexpr int32_t kTypes[] = {TM_FLOAT,  TM_FLOAT,  TM_COLOR,  TM_POINT,
                                       TM_VECTOR, TM_NORMAL, TM_MATRIX, TM_STRING};
  int32_t type = kTypes[static_cast<size_t>(p.type.base)];
  if (p.output) type |= TM_OUTPUT;
  if (p.type.isArray() || p.type.is(Base::Matrix)) type |= kArrayVaries;
  if (p.beginsOutput) type |= kBeginsOutput;
  return type;
}

/// Returns the parameters that a light's shadow() reads as shadow maps, which the host needs to know.
std::vector<bool> shadowMaps(const Code& code) {
  std::vector<bool> out(code.parameters.size(), false);
  if (code.kind != ShaderKind::Light) return out;
  forEach(code.body, [&](const Instruction& i) {
    if (i.op != Op::Shadow) return;
    const Register& name = code.registers[static_cast<size_t>(i.in[0])];
    if (name.origin == Origin::Parameter && name.length == 0) out[static_cast<size_t>(name.index)] = true;
  });
  return out;
}

/// Refuses code whose registers need too much memory for a batch of points in each thread.
void refuseHuge(const Code& code, Messages& messages) {
  constexpr double kBatch = 256, kMegabyte = 1 << 20, kMost_bytes = 128 * kMegabyte;
  const auto bytes = [](bool varies, double floats) { return floats * sizeof(float) * (varies ? kBatch : kBlock); };
  const double needed_bytes = bytes(true, code.varyingFloats) + bytes(false, code.uniformFloats);
  if (needed_bytes <= kMost_bytes) return;
  const auto own_bytes = [&](const Register& r) {
    return bytes(r.varying, static_cast<double>(std::max(1, r.length)) * floatsOf(r.shape));
  };
  const auto largest =
      std::max_element(code.registers.begin(), code.registers.end(),
                       [&](const Register& a, const Register& b) { return own_bytes(a) < own_bytes(b); });
  messages.error(largest->place,
                 fmt::format("the variables of this shader need {} MB for {} points, \"{}\" most of it; {} MB are the "
                             "limit",
                             std::ceil(needed_bytes / kMegabyte), kBatch, largest->name, kMost_bytes / kMegabyte),
                 static_cast<int32_t>(largest->name.size()));
}

/// Tells whether a shader on a surface takes derivatives. Those of parameters are 0 in code whose parameters are
/// uniform, and are asked of the host where primitive variables give them.
bool takesDerivatives(const Code& lowered) {
  bool found = false;
  forEach(lowered.body, [&](const Instruction& i) { found |= i.op == Op::StepU || i.op == Op::StepV; });
  return found && (lowered.kind == ShaderKind::Surface || lowered.kind == ShaderKind::Volume);
}

std::unique_ptr<const Program> programOf(Code code, const std::vector<bool>& varying, Messages& messages) {
  optimise(code, varying, messages);
  return std::make_unique<Program>(std::move(code));
}

}  // namespace

HostedShader::HostedShader(Code lowered, Messages& messages) : lowered_(std::move(lowered)) {
  if (messages.hasErrors()) {
    uniform_ = std::make_unique<Program>(Code());
    return;
  }
  if (movesPoints(lowered_)) {
    Messages told;  // dropped, since the messages are those of the surface
    displacement_ = std::make_unique<HostedShader>(displacementOf(lowered_), told);
    leavePoints(lowered_);
  }
  uniform_ = programOf(lowered_, std::vector<bool>(lowered_.parameters.size(), false), messages);
  refuseHuge(code(), messages);
  declareParameters();
  const bool hasExtent = lowered_.onGeometry || (code().capabilities & TM_LIGHT_SKY) != 0;
  if (hasExtent) declareExtent();
  TmShader& host = host_.shader;
  host_.owner = this;
  host.abi = TM_SHADER_ABI;
  host.structBytes = sizeof host;
  host.kind = kindOf(lowered_.kind);
  host.capabilities = code().capabilities;
  if (takesDerivatives(lowered_)) host.capabilities |= TM_DERIVATIVES;
  host.paramCount = static_cast<int32_t>(params_.size());
  host.paramBytes = sizeof(TmParamDecl);
  host.params = params_.data();
  host.shade = shade;
  host.name = lowered_.name.c_str();
  host.doc = lowered_.doc.c_str();
  if (hasExtent) host.capabilities |= TM_LIGHT_SHADOWED;
  if (lowered_.onGeometry) host.capabilities |= TM_LIGHT_AREA;
}

bool HostedShader::canBeOnGeometry() const {
  const bool distant = (code().capabilities & (TM_LIGHT_AMBIENT | TM_LIGHT_SOLAR)) != 0;
  return lowered_.asksPlace && !distant;
}

const HostedShader* HostedShader::of(const TmShader& shader) {
  return shader.shade == shade ? reinterpret_cast<const Hosted*>(&shader)->owner : nullptr;
}

void HostedShader::declareParameters() {
  const std::vector<bool> maps = shadowMaps(code());
  strings_.reserve(lowered_.parameters.size());
  for (size_t k = 0; k < lowered_.parameters.size(); ++k) {
    const Parameter& p = lowered_.parameters[k];
    std::vector<const char*>& texts = strings_.emplace_back();
    for (const std::string& text : p.texts) texts.push_back(text.c_str());
    params_.push_back({p.name.c_str(), typeOf(p), std::max(1, p.type.length), p.floats.data(), texts.data(), "",
                       maps[k] ? TM_ROLE_SHADOW_MAP : TM_ROLE_NONE});
  }
}

/// Declares the parameters of a light with an extent, which the language cannot declare.
void HostedShader::declareExtent() {
  static constexpr float kSamples = kDefaultLightSamples, kNo = 0;
  declareForHost("__samples", TM_ROLE_SAMPLES, &kSamples);
  declareForHost("__visible", TM_ROLE_VISIBLE, &kNo);
}

/// Gives the role to the shader's own parameter of that name, or adds one.
void HostedShader::declareForHost(const char* name, TmRole role, const float* value) {
  for (TmParamDecl& p : params_)
    if (std::string_view(p.name) == name && p.type == TM_FLOAT && p.arrayLength == 1) {
      p.role = role;
      return;
    }
  params_.push_back({name, TM_FLOAT, 1, value, nullptr, "", role});
}

std::vector<bool> HostedShader::varyingOf(const TmValue* params) const {
  std::vector<bool> varying;
  for (size_t k = 0; k < lowered_.parameters.size(); ++k) {
    if (params[k].step == 0 || lowered_.parameters[k].output) continue;
    varying.resize(params_.size(), false);
    varying[k] = true;
  }
  return varying;
}

const Program& HostedShader::programFor(const TmGrid& grid) const {
  const std::vector<bool> varying = varyingOf(grid.params);
  if (varying.empty()) return *uniform_;
  const std::lock_guard lock(mutex_);
  std::unique_ptr<const Program>& program = others_[varying];
  Messages told;  // dropped, since the first code has given the same messages
  if (!program) program = programOf(lowered_, varying, told);
  return *program;
}

void HostedShader::shade(const TmGrid* grid) {
  if (grid->count == 0) return;
  const HostedShader* hosted = reinterpret_cast<const Hosted*>(grid->shader)->owner;
  run(hosted->programFor(*grid), *grid);
}

}  // namespace tomales::compiler

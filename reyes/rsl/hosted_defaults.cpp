// Values that a shader computes when it runs: the host may ask for a default, or for a lamp's cone, alone.
#include <algorithm>

#include "reyes/rsl/globals.h"
#include "reyes/rsl/hosted_shader.h"
#include "reyes/rsl/machine/machine.h"
#include "reyes/rsl/passes/passes.h"
#include "reyes/rsl/passes/walk.h"

namespace tomales::compiler {
namespace {

bool isControl(Op op) { return op == Op::If || op == Op::Loop || op == Op::Scope || op == Op::Leave; }

/// Tells whether the code gives the same for all points of all scenes.
bool isFixed(const Code& code) {
  bool fixed = true;
  forEach(code.body, [&](const Instruction& i) {
    const bool step = i.op == Op::StepU || i.op == Op::StepV;
    fixed &= (info(i.op).pure() && !step) || i.op == Op::Copy || i.op == Op::SetElement || isControl(i.op);
    forEachRead(i, [&](int32_t r) { fixed &= code.registers[static_cast<size_t>(r)].origin != Origin::Global; });
  });
  return fixed;
}

/// A grid of one point for code that needs nothing of it except report().
struct LonePoint {
  explicit LonePoint(const TmValue* params) {
    services.report = [](void*, const TmGrid*, int32_t, const char*) {};
    grid.structBytes = sizeof grid;
    grid.count = 1;
    grid.padded = TM_LANES;
    grid.active = active;
    grid.params = params;
    grid.call = &services;
  }
  alignas(64) uint8_t active[TM_LANES] = {1};
  TmServices services{};
  TmGrid grid{};
};

}  // namespace

bool HostedShader::computes(size_t parameter) const {
  return parameter < lowered_.parameters.size() && lowered_.parameters[parameter].computed;
}

const Program& HostedShader::defaultProgram(size_t parameter, const TmValue* params) const {
  std::vector<bool> varying = varyingOf(params);
  varying.resize(params_.size(), false);
  const std::lock_guard lock(mutex_);
  std::unique_ptr<const Program>& program = defaults_[{parameter, varying}];
  if (program) return *program;
  Messages told;  // dropped, since the whole code has given the same messages
  Code code = defaultOf(lowered_, parameter);
  optimise(code, varying, told);
  program = std::make_unique<Program>(std::move(code));
  return *program;
}

RslValue HostedShader::value(size_t parameter, const TmGrid& grid) const {
  return valueOf(defaultProgram(parameter, grid.params), grid, static_cast<int32_t>(parameter));
}

std::optional<RslValue> HostedShader::fixedValue(size_t parameter, const TmValue* params) const {
  const Program& program = defaultProgram(parameter, params);
  if (!isFixed(program.code())) return std::nullopt;
  return valueOf(program, LonePoint(params).grid, static_cast<int32_t>(parameter));
}

/// Returns the code that computes the cone, the same for all points; null if it depends on the point.
const Program* HostedShader::coneProgram() const {
  const std::lock_guard lock(mutex_);
  for (const bool ofAllBranches : {false, true}) {
    if (cone_) break;
    Messages told;  // dropped, since the whole code has given the same messages
    Code code = coneOf(lowered_, ofAllBranches);
    optimise(code, std::vector<bool>(code.parameters.size(), false), told);
    if (isFixed(code) || ofAllBranches) cone_ = std::make_unique<Program>(std::move(code));
  }
  return isFixed(cone_->code()) ? cone_.get() : nullptr;
}

// A lamp whose cone depends on the point shines from its front, as nearly all do.
bool HostedShader::shinesAllRound(const TmValue* params) const {
  if (!lowered_.onGeometry || lowered_.allRound || lowered_.cone < 0) return lowered_.onGeometry && lowered_.allRound;
  const Program* program = coneProgram();
  if (!program) return false;
  const size_t count = lowered_.parameters.size();
  std::vector<TmValue> values(params, params + count);
  const float none = 0;
  values.emplace_back().c[0] = &none;
  const RslValue cone = valueOf(*program, LonePoint(values.data()).grid, static_cast<int32_t>(count));
  return cone.floats[0] > kRightAngle;
}

}  // namespace tomales::compiler

namespace tomales {

bool rslComputesDefault(const TmShader& shader, int32_t parameter) {
  const compiler::HostedShader* hosted = compiler::HostedShader::of(shader);
  return hosted && hosted->computes(static_cast<size_t>(parameter));
}

RslValue rslValue(const TmShader& shader, int32_t parameter, const TmGrid& grid) {
  return compiler::HostedShader::of(shader)->value(static_cast<size_t>(parameter), grid);
}

std::optional<RslValue> rslFixedValue(const TmShader& shader, int32_t parameter, const TmValue* params) {
  return compiler::HostedShader::of(shader)->fixedValue(static_cast<size_t>(parameter), params);
}

}  // namespace tomales

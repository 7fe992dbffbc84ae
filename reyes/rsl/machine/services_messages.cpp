// Questions of shaders about each other, about attributes and options, and about the ray that came (RISpec 15.8).
#include "reyes/rsl/machine/call.h"

namespace tomales::compiler {
namespace {

/// Gives 1, and sets the one entry of the settings, if there is a value of that name and type; otherwise gives 0.
void ask(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  int32_t type = 0;
  TmValue v{};
  const int32_t light = s.of->extra == TM_OF_LIGHT ? run.light : -1;
  const bool told = call.services.ask(call.host, call.g, s.of->extra, light, call.text(0), &type, &v) != 0;
  call.set(told && fill(run, s.of->settings.at(0).value, type, v) ? 1.0f : 0.0f);
}

/// The names that RSL's shadername() has for other shaders, in the order of TmWhom.
constexpr std::string_view kWhom[] = {"surface", "displacement", "atmosphere", "incident", "opposite", "light"};

/// Gives an empty text if there is no such shader.
void shaderName(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const auto whom = static_cast<int32_t>(std::find(std::begin(kWhom), std::end(kWhom), call.text(0)) - kWhom);
  int32_t type = 0;
  TmValue v{};
  const bool told =
      call.services.ask(call.host, call.g, whom, run.light, "__shadername", &type, &v) && type == TM_STRING;
  run.variableText(s.of->out[0]) = told ? v.string : "";
}

/// Answers the names that are texts in RSL and numbers to the host.
bool rayText(Call& call, const std::string& name, std::string& out) {
  static const char* const kTypes[] = {"camera", "diffuse", "specular", "transmission"};
  if (name == "label") {
    out = call.services.rayLabel(call.host, call.g);
    return true;
  }
  if (name != "type") return false;
  const auto n = static_cast<size_t>(call.run.padded);
  float* const x = call.run.memory.floats(3 * n);
  std::fill_n(x, 3 * n, 0.0f);
  if (!call.services.rayInfo(call.host, call.g, "type", {x, x + n, x + 2 * n})) return false;
  out = kTypes[std::clamp(static_cast<int>(x[call.run.firstActive()]), 0, 3)];
  return true;
}

void rayInfo(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const int32_t to = s.of->settings.at(0).value;
  if (run.reg(to).shape == Shape::Text)
    return call.set(rayText(call, run.text(s.of->in[0]), run.variableText(to)) ? 1.0f : 0.0f);
  const auto n = static_cast<size_t>(run.padded);
  float* const x = run.memory.floats(3 * n);
  const bool told = call.services.rayInfo(call.host, call.g, call.text(0), {x, x + n, x + 2 * n}) != 0;
  const TmValue v{{x, x + n, x + 2 * n}, 1, 1, nullptr};
  call.set(told && fill(run, to, run.reg(to).shape == Shape::Number ? TM_FLOAT : TM_VECTOR, v) ? 1.0f : 0.0f);
}

void rayLabel(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  run.variableText(s.of->out[0]) = call.services.rayLabel(call.host, call.g);
}

constexpr Row kMessageRows[] = {
    {Op::Ask, ask}, {Op::ShaderName, shaderName}, {Op::RayInfo, rayInfo}, {Op::RayLabel, rayLabel}};

}  // namespace

std::span<const Row> messageRows() { return kMessageRows; }

}  // namespace tomales::compiler

// A text, compiled and run over a batch of points that a renderer of answers on paper serves.
#pragma once
#include <algorithm>
#include <deque>
#include <vector>

#include "reyes/rsl/hosted_shader.h"
#include "reyes/rsl/lower.h"
#include "reyes/rsl/parse.h"
#include "tests/unit/rsl_machine/fake_grid.h"

namespace tomales::compiler {

struct CompiledText {
  explicit CompiledText(const std::string& text)
      : checked(check(parse(preprocessText("case.sl", text, {}, sources, messages), messages), messages)) {
    if (!messages.hasErrors())
      for (const auto& s : checked.file.shaders) shaders.emplace_back(lower(checked, *s, messages), messages);
  }
  bool good() const { return !messages.hasErrors() && !shaders.empty(); }
  std::string said() const { return messages.rendered(sources); }
  const HostedShader& shader() const { return shaders.front(); }

  Sources sources;
  Messages messages;
  Checked checked;
  std::deque<HostedShader> shaders;
};

/// The place of an output among the parameters, whose values it is given have the same name.
inline size_t outputNamed(const CompiledText& compiled, std::string_view name) {
  const std::vector<Parameter>& all = compiled.shader().lowered().parameters;
  const auto it = std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.output && p.name == name; });
  return static_cast<size_t>(it - all.begin());
}

/// Over one micropolygon s changes by 1 along u, t by 3 along v, and P by (1, 0, 0) and (0, 2, 0); two lights: one
/// that lights all points and one that lights those of odd numbers.
class ServedGrid : public FakeGrid {
 public:
  explicit ServedGrid(int count) : FakeGrid(count) {
    lights = {{[](int) { return true; }, {0, 0, -2}, {1, 2, 3}, 0.25f},
              {[](int i) { return i % 2 == 1; }, {0, -3, 0}, {0.5f, 0.5f, 0.5f}, 0.75f}};
    const TmVec3 across = triples(), along = triples();
    for (int i = 0; i < n; ++i) {
      rsl::set(across, i, {4, 0, 0});
      rsl::set(along, i, {0, 4, 0});
    }
    grid.dPdu = rsl::view(across);
    grid.dPdv = rsl::view(along);
    changes = {{grid.s, 1, 0}, {grid.t, 0, 3}, {grid.P.x, 1, 0}, {grid.P.y, 0, 2}};
    services.derivative = [](void* h, const TmGrid* g, int32_t direction, const float* x, float* out) {
      const ServedGrid& me = *static_cast<ServedGrid*>(static_cast<FakeGrid*>(h));
      const auto it = std::find_if(me.changes.begin(), me.changes.end(),
                                   [&](const Change& c) { return std::equal(x, x + g->padded, c.of); });
      for (int i = 0; i < g->count; ++i)
        out[i] = it == me.changes.end() ? 0 : direction == 0 ? it->u / g->du[i] : it->v / g->dv[i];
    };
  }
  /// Points whose hash is even take no part.
  void maskAtRandom() {
    for (int i = 0; i < grid.count; ++i) active[static_cast<size_t>(i)] = rsl::latticeHash(i, grid.count, 77) % 2 != 0;
  }
  /// Does what the host does before a shader runs. Outputs of active points are 0.
  void bindOutputs(const Code& code) {
    bind(code);
    for (size_t k = 0; k < params.size(); ++k)
      if (code.parameters[k].output)
        for (size_t component = 0; component < 3; ++component) {
          float* const out = const_cast<float*>(params[k].c[component]);
          for (int i = 0; i < n; ++i) out[i] = i < grid.count && active[static_cast<size_t>(i)] ? 0 : kBefore.x;
        }
  }
  void run(const HostedShader& shader) {
    bindOutputs(shader.lowered());
    runBound(shader);
  }
  void runBound(const HostedShader& shader) {
    grid.shader = shader.host();
    shader.host()->shade(&grid);
  }

  struct Change {
    const float* of;
    float u, v;
  };
  std::vector<Change> changes;
};

}  // namespace tomales::compiler

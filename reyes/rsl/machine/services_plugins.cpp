// Calls functions of plugins (reyes/shader/functions.h).
#include "reyes/rsl/machine/call.h"

namespace tomales::compiler {
namespace {

/// Copies the matrix of the first active point, which counts for all.
TmValue matrixOf(Run& run, int32_t r) {
  float* const to = run.memory.floats(16);
  const Lanes& l = run.lane(r);
  const ptrdiff_t point = l.block != 0 ? run.firstActive() : 0;
  for (ptrdiff_t k = 0; k < 16; ++k) to[k] = l.data[k * run.stride(r) + point];
  return {{to, nullptr, nullptr}, 0, 1, nullptr};
}

/// Refers to a number or triple in place.
TmValue valueOf(const Run& run, int32_t r, Base base) {
  const Lanes& l = run.lane(r);
  TmValue v{{l.data, nullptr, nullptr}, l.block != 0, 1, nullptr};
  // A number counts for all components where a triple is wanted.
  if (base != Base::Float) {
    v.c[1] = l.data + l.component;
    v.c[2] = l.data + 2 * static_cast<ptrdiff_t>(l.component);
  }
  return v;
}

TmValue given(Call& call, int32_t to, bool triple) {
  if (!triple) return {{call.giveNumberTo(to), nullptr, nullptr}, 1, 1, nullptr};
  const TmVec3 v = call.giveTripleTo(to);
  return {{v.x, v.y, v.z}, 1, 1, nullptr};
}

void plugin(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const Builtin& function = *run.program.code().plugins[static_cast<size_t>(s.of->extra)];
  std::vector<TmValue> args;
  auto out = s.of->out.begin();
  if (function.result != Base::Void) args.push_back(given(call, *out++, function.result != Base::Float));
  for (size_t k = 0; k < function.slots.size(); ++k) {
    const Slot& slot = function.slots[k];
    const int32_t r = s.of->in[k];
    if (slot.output)
      args.push_back(given(call, *out++, slot.base != Base::Float));
    else if (slot.base == Base::String)
      args.push_back({{nullptr, nullptr, nullptr}, 0, 1, run.text(r).c_str()});
    else
      args.push_back(slot.base == Base::Matrix ? matrixOf(run, r) : valueOf(run, r, slot.base));
  }
  const TmFunctionCall c{sizeof c, run.count, run.mask->on, args.data()};
  function.plugin->call(&c);
}

constexpr Row kPluginRows[] = {{Op::Plugin, plugin}};

}  // namespace

std::span<const Row> pluginRows() { return kPluginRows; }

}  // namespace tomales::compiler

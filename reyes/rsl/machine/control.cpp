// Blocks, conditions, loops, and the instruction that leaves them.
#include <atomic>
#include <optional>

#include "reyes/base/stop.h"
#include "reyes/rsl/machine/machine.h"
#include "reyes/rsl/machine/masks.h"
#include "reyes/rsl/machine/table.h"

namespace tomales::compiler {
namespace {

// A loop of ten instructions takes about a microsecond an iteration of 256 points, so this is some seconds.
std::atomic<int64_t> loopLimit{5'000'000};

void executeIf(Run& run, const PreparedInstruction& s) {
  const Lanes& condition = run.lane(s.of->in[0]);
  const bool hasOther = s.blocks.size() > 1 && !s.blocks[1].empty();
  if (condition.block == 0) {
    if (*condition.data != 0)
      execute(run, s.blocks[0]);
    else if (hasOther)
      execute(run, s.blocks[1]);
    return;
  }
  const Borrowed borrowed(run.memory);
  const auto n = static_cast<size_t>(run.padded);
  uint8_t *const body = run.memory.bytes(n), *const other = run.memory.bytes(n);
  bool anyOther = false;
  const bool any = narrow(run.padded, run.mask->on, condition.data, body, other, anyOther);
  if (any) {
    std::optional<Narrowed> inner;
    if (anyOther) inner.emplace(run, body);
    execute(run, s.blocks[0]);
  }
  if (anyOther && hasOther && run.mask->any) {
    std::optional<Narrowed> inner;
    if (any) inner.emplace(run, other);
    execute(run, s.blocks[1]);
  }
}

/// Counts an iteration. Returns whether the loop may go round once more.
bool goesOn(Run& run) {
  const int64_t limit = loopLimit.load(std::memory_order_relaxed);
  const bool endless = limit > 0 && ++run.iterations > limit;
  if (endless)
    run.missing("loops without end: " + std::to_string(limit) + " iterations have not finished it; it is left there");
  if (endless || stopRequested()) endAll(run);
  return run.mask->any;
}

/// Keeps the points for which the condition holds. Returns false if there are none.
bool keep(Run& run, int32_t condition) {
  const Lanes& c = run.lane(condition);
  if (c.block == 0) return *c.data != 0;
  const Borrowed borrowed(run.memory);
  uint8_t* const ended = run.memory.bytes(static_cast<size_t>(run.padded));
  bool some = false;
  Mask& mask = *run.mask;
  mask.any = narrow(run.padded, mask.on, c.data, mask.on, ended, some);
  mask.full = mask.full && !some;
  return mask.any;
}

void executeLoop(Run& run, const PreparedInstruction& s) {
  const Borrowed borrowed(run.memory);
  const int32_t condition = s.of->in[0], label = s.of->extra;
  std::optional<Narrowed> inside;
  if (s.left[0] || run.varies(condition)) inside.emplace(run, label);
  while (goesOn(run)) {
    execute(run, s.blocks[0]);
    if (!run.mask->any || !keep(run, condition)) return;
    if (s.left[1]) {
      const Borrowed once(run.memory);
      const Narrowed body(run, label + 1);
      execute(run, s.blocks[1]);
    } else {
      execute(run, s.blocks[1]);
    }
    if (run.mask->any && s.blocks.size() > 2) execute(run, s.blocks[2]);
  }
}

void executeScope(Run& run, const PreparedInstruction& s) {
  if (!s.left[0]) return execute(run, s.blocks[0]);
  const Borrowed borrowed(run.memory);
  const Narrowed inside(run, s.of->extra);
  execute(run, s.blocks[0]);
}

/// Takes the active points out of all masks up to that of the label.
void executeLeave(Run& run, const PreparedInstruction& s) {
  for (Mask* m = run.mask; m->label != s.of->extra && m->outer;) {
    m = m->outer;
    m->any = remove(run.padded, run.mask->on, m->on);
    m->full = false;
  }
  std::fill_n(run.mask->on, run.padded, uint8_t{0});
  run.mask->any = run.mask->full = false;
}

constexpr Row kControlRows[] = {
    {Op::If, executeIf}, {Op::Loop, executeLoop}, {Op::Scope, executeScope}, {Op::Leave, executeLeave}};

}  // namespace

std::span<const Row> controlRows() { return kControlRows; }

void setLoopLimit(int64_t iterations) { loopLimit = iterations; }

void execute(Run& run, const PreparedBlock& block) {
  for (const PreparedInstruction& s : block) {
    s.execute(run, s);
    if (!run.mask->any) return;
  }
}

void endAll(Run& run) {
  for (Mask* m = run.mask; m; m = m->outer) {
    std::fill_n(m->on, run.padded, uint8_t{0});
    m->any = m->full = false;
  }
}

}  // namespace tomales::compiler

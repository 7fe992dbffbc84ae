// One run of a program: where its registers are, and which points are active.
#pragma once
#include "reyes/rsl/machine/memory.h"
#include "reyes/rsl/machine/program.h"
#include "reyes/shader_api.h"

namespace tomales::compiler {

/// Which points are active, where control has narrowed it. They lie within each other: a point of an inner one is in
/// all around it. A byte each, 1 or 0, as TmGrid::active; 0 beyond the batch.
struct Mask {
  uint8_t* on = nullptr;
  bool any = true;   ///< Some are.
  bool full = true;  ///< All are that were active at first. (What happens to others does not matter.)
  Mask* outer = nullptr;
  int32_t label = -1;  ///< Leave that ends here.
};

struct Run {
  Run(const Program& p, const TmGrid& g);
  Run(const Run&) = delete;

  const Program& program;
  const TmGrid& given;
  TmGrid grid;  ///< As `given`, with the mask of now once asking() has set it.
  int32_t count, padded, blocks;
  Memory& memory;
  Borrowed borrowed{memory};
  Lanes* lanes = nullptr;  ///< Of all registers of numbers.
  size_t texts = 0;        ///< The first of this run.
  Mask whole;
  Mask* mask = &whole;
  bool everywhere = false;  ///< All points were active at first, and there is no padding.
  int32_t light = -1;       ///< Inside illuminance: which.
  int32_t randoms = 0;      ///< Calls of random() so far.
  float specularScale = 0;  ///< 0: not asked yet.
  int64_t iterations = 0;   ///< Of all loops.

  const Register& reg(int32_t r) const { return program.reg(r); }
  const Lanes& lane(int32_t r) const { return lanes[r]; }
  bool varies(int32_t r) const { return lanes[r].block != 0; }
  /// From one component, or element of an array, to the next.
  int32_t stride(int32_t r) const {
    const Lanes& l = lanes[r];
    return l.component != 0 ? l.component : l.block != 0 ? padded : kBlock;
  }
  const std::string& text(int32_t r, int32_t element = 0) const;
  std::string& variableText(int32_t r, int32_t element = 0) {
    return memory.text(texts + static_cast<size_t>(program.located(r).at + element));
  }
  /// For a call of a service.
  const TmGrid* asking() { return grid.active = mask->on, &grid; }
  int32_t firstActive() const;
  void warn(const std::string& message);
  void missing(const std::string& message);
};

/// Makes a register of `width` components these arrays, which lie evenly apart; false: they do not.
bool useArrays(Lanes& l, int32_t width, const float* x, const float* y, const float* z);

/// The registers of globals and parameters, before the program runs (given.cpp); and what is stored afterwards.
void open(Run& run);
void store(Run& run);

void execute(Run& run, const Steps& steps);
/// Nobody is active any more.
void endAll(Run& run);

}  // namespace tomales::compiler

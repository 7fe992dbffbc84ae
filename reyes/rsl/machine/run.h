// One run of a program: where its registers are, and which points are active.
#pragma once
#include "reyes/rsl/machine/memory.h"
#include "reyes/rsl/machine/program.h"
#include "reyes/shader_api.h"

namespace tomales::compiler {

/// The active points, after narrowing by control structures. Masks are nested: a point of an inner mask is in all outer
/// ones. Each point has a byte, 1 or 0, as in TmGrid::active; bytes beyond the batch are 0.
struct Mask {
  uint8_t* on = nullptr;
  bool any = true;   ///< Some points are active.
  bool full = true;  ///< All points that were active at the start still are; others do not matter.
  Mask* outer = nullptr;
  int32_t label = -1;  ///< The label whose Leave ends here.
};

struct Run {
  Run(const Program& p, const TmGrid& g);
  Run(const Run&) = delete;

  const Program& program;
  const TmGrid& given;
  TmGrid grid;  ///< A copy of `given`, whose mask asking() sets to the present one.
  int32_t count, padded, blocks;
  Memory& memory;
  Borrowed borrowed{memory};
  Lanes* lanes = nullptr;  ///< All registers that hold numbers.
  size_t texts = 0;        ///< The number of this run's first text.
  Mask whole;
  Mask* mask = &whole;
  bool everywhere = false;  ///< True if all points were active at the start and there is no padding.
  int32_t light = -1;       ///< The light of the illuminance loop that is running; -1 if none is.
  int32_t randoms = 0;      ///< The number of calls of random() so far.
  float specularScale = 0;  ///< 0 until it has been asked for.
  int64_t iterations = 0;   ///< The iterations of all loops together.

  const Register& reg(int32_t r) const { return program.reg(r); }
  const Lanes& lane(int32_t r) const { return lanes[r]; }
  bool varies(int32_t r) const { return lanes[r].block != 0; }
  /// Returns the distance in floats from one component, or element of an array, to the next.
  int32_t stride(int32_t r) const {
    const Lanes& l = lanes[r];
    return l.component != 0 ? l.component : l.block != 0 ? padded : kBlock;
  }
  const std::string& text(int32_t r, int32_t element = 0) const;
  std::string& variableText(int32_t r, int32_t element = 0) {
    return memory.text(texts + static_cast<size_t>(program.located(r).at + element));
  }
  /// Returns the batch with its present mask, for a call of a service.
  const TmGrid* asking() {
    grid.active = mask->on;
    return &grid;
  }
  int32_t firstActive() const;
  void warn(const std::string& message);
  void missing(const std::string& message);
};

/// Lets a register use these arrays of `width` components. Returns false if their distances differ.
bool useArrays(Lanes& l, int32_t width, const float* x, const float* y, const float* z);

/// Sets the registers of globals and parameters before the program runs; store() takes its results (both in
/// host_values.cpp).
void open(Run& run);
void store(Run& run);

void execute(Run& run, const PreparedBlock& block);
/// Makes all points inactive for the rest of the run.
void endAll(Run& run);

}  // namespace tomales::compiler

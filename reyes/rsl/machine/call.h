// One call of a service: passes the arguments as arrays, and puts the results into registers.
#pragma once
#include <vector>

#include "reyes/rsl/machine/masks.h"
#include "reyes/rsl/machine/table.h"

namespace tomales::compiler {

/// At its end the results are in their registers, for active points. In temporaries the other points hold 0.
class Call {
 public:
  Call(Run& r, const PreparedInstruction& s) : run(r), of(*s.of) {}
  ~Call() { finish(); }
  Call(const Call&) = delete;

  Run& run;
  const Instruction& of;
  const TmGrid* g = run.asking();
  const TmServices& services = *g->call;
  void* const host = g->host;

  bool has(size_t k) const { return k < of.in.size() && of.in[k] >= 0; }
  TmConstVec3 triple(size_t k) { return tripleOf(of.in[k]); }
  /// Returns a copy of an argument, so that the body of a loop cannot change it.
  TmConstVec3 copied(size_t k);
  const float* number(size_t k) { return numberOf(of.in[k]); }
  const char* text(size_t k) const { return run.text(of.in[k]).c_str(); }
  /// Returns one value for all points. If points differ, it is that of the first active point, and a warning is
  /// reported.
  float one(size_t k, const char* what);
  /// Returns one() as a whole number; 0 if it does not fit an int.
  int32_t whole(size_t k, const char* what);

  /// Returns the arrays for the service to fill.
  TmVec3 giveTriple(size_t k = 0) { return giveTripleTo(of.out[k]); }
  float* giveNumber(size_t k = 0) { return giveNumberTo(of.out[k]); }
  /// Sets a result to one value at all active points.
  void set(float value, size_t k = 0);
  /// Copies results of the service so far to their registers of one value.
  void finish();

  TmConstVec3 tripleOf(int32_t r);
  const float* numberOf(int32_t r);
  TmVec3 giveTripleTo(int32_t r);
  float* giveNumberTo(int32_t r);

 private:
  float* give(int32_t r, int32_t width, int32_t apart);
  static constexpr float kMostWhole = 1e9f;
  const Borrowed borrowed_{run.memory};
  struct Pending {
    int32_t r;
    const float* from;
    int32_t component;
  };
  std::vector<Pending> pending_;  ///< Registers of one value for which the service writes one value for each point.
};

/// Puts a value from ask() or textureInfo() into a register, for active points. Returns false, and changes nothing, if
/// it has another type.
bool fill(Run& run, int32_t to, int32_t type, const TmValue& v);

}  // namespace tomales::compiler

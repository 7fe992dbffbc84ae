// One call of a service: arguments as the arrays that it wants, results back into registers.
#pragma once
#include <vector>

#include "reyes/rsl/machine/masks.h"
#include "reyes/rsl/machine/table.h"

namespace tomales::compiler {

/// Results are in their registers when it ends: for active points. What is not active of a temporary is 0.
class Call {
 public:
  Call(Run& r, const Step& s) : run(r), of(*s.of) {}
  ~Call() { finish(); }
  Call(const Call&) = delete;

  Run& run;
  const Instruction& of;
  const TmGrid* g = run.asking();
  const TmServices& services = *g->call;
  void* const host = g->host;

  bool has(size_t k) const { return k < of.in.size() && of.in[k] >= 0; }
  TmConstVec3 triple(size_t k) { return tripleOf(of.in[k]); }
  /// Its own copy, which a body may not assign.
  TmConstVec3 copied(size_t k);
  const float* number(size_t k) { return numberOf(of.in[k]); }
  const char* text(size_t k) const { return run.text(of.in[k]).c_str(); }
  /// One value for all: of points that differ the first active one's, which is reported.
  float one(size_t k, const char* what);
  /// The same as a whole number; 0 where it is none.
  int32_t whole(size_t k, const char* what);

  /// To be filled by the service.
  TmVec3 giveTriple(size_t k = 0) { return giveTripleTo(of.out[k]); }
  float* giveNumber(size_t k = 0) { return giveNumberTo(of.out[k]); }
  /// The same for all active points.
  void set(float value, size_t k = 0);
  /// Registers of one value take what the service has given so far.
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
  std::vector<Pending> pending_;  ///< Registers of one value, whose service gives one for each point.
};

/// A value that ask() or textureInfo() has told, into a register, for active points. False, and nothing changes: it has
/// another type.
bool fill(Run& run, int32_t to, int32_t type, const TmValue& v);

}  // namespace tomales::compiler

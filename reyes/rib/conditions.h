// IfBegin, ElseIf, Else and IfEnd, which decide which requests of a file are read.
#pragma once
#include "reyes/rib.h"
#include "reyes/rib/expression.h"

namespace tomales::rib {

class Conditions {
 public:
  Conditions(Log& log, Variables variables) : log_(log), variables_(std::move(variables)) {}

  /// Returns true if nothing more is to be done with the request: it is one of the four, or in a branch that is not
  /// read.
  bool take(const Request& request);
  /// Call it at the end of the file.
  void finish();

  /// Returns false in a branch that is not read.
  bool reads() const { return levels_.empty() || levels_.back().reads; }

 private:
  struct Level {
    SourceLoc where;
    bool reads, settled;  ///< settled: a branch has been read, or none is to be read.
  };
  bool conditionHolds(const Request& request) const;

  Log& log_;
  Variables variables_;
  std::vector<Level> levels_;
};

}  // namespace tomales::rib

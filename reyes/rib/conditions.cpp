#include "reyes/rib/conditions.h"

#include <fmt/format.h>

namespace tomales::rib {

bool Conditions::take(const Request& r) {
  const bool otherwise = r.name == "ElseIf" || r.name == "Else", ends = r.name == "IfEnd";
  if (r.name == "IfBegin") {
    const bool outer = reads(), yes = outer && conditionHolds(r);
    levels_.push_back({r.where, yes, yes || !outer});
  } else if ((otherwise || ends) && levels_.empty()) {
    log_.report(Severity::Warning, "rib-unbalanced", r.where, r.name + " without IfBegin, ignored");
  } else if (ends) {
    levels_.pop_back();
  } else if (otherwise) {
    Level& level = levels_.back();
    level.reads = !level.settled && (r.name == "Else" || conditionHolds(r));
    level.settled |= level.reads;
  } else {
    return !reads();
  }
  return true;
}

void Conditions::finish() {
  for (const Level& level : levels_)
    log_.report(Severity::Warning, "rib-unbalanced", level.where, "IfBegin: IfEnd is missing");
  levels_.clear();
}

bool Conditions::conditionHolds(const Request& r) const {
  try {
    return holds(r.args[0].strings[0], variables_);
  } catch (const ExpressionError& e) {
    log_.report(Severity::Warning, "rib-condition", r.where,
                fmt::format("{} \"{}\": {}; the condition counts as false", r.name, r.args[0].strings[0].substr(0, 200),
                            e.what()));
    return false;
  }
}

}  // namespace tomales::rib

// Builds Prims of NuPatch, Points and Curves requests (RISpec 3.2 section 5).
#include "reyes/rib/geometry_builders.h"

namespace tomales::rib {
namespace {

NurbsDirection nurbsDirection(const Request& r, size_t first) {
  const auto number = [&](size_t k) { return r.args[first + k].numbers[0]; };
  return {r.args[first].integer(), r.args[first + 1].integer(), r.args[first + 2].numbers, number(3), number(4)};
}

}  // namespace

bool isPeriodic(const std::string& wrap, Problems& problems) {
  if (wrap != "periodic" && wrap != "nonperiodic")
    problems.push_back("unknown wrap \"" + wrap + "\"; it is taken for nonperiodic");
  return wrap == "periodic";
}

PrimPtr nuPatch(const Request& r, const Scope& s, Problems& problems) {
  return makeNuPatch(nurbsDirection(r, 0), nurbsDirection(r, 5), *s.trim, r.params, problems);
}

PrimPtr points(const Request& r, const Scope&, Problems& problems) { return makePoints(r.params, problems); }

PrimPtr curves(const Request& r, const Scope& s, Problems& problems) {
  const std::string &type = r.args[0].strings[0], &wrap = r.args[2].strings[0];
  if (type != "linear" && type != "cubic") throw PrimError("unknown type of curve \"" + type + "\"");
  // Ribbons that have a normal of their own cannot be round.
  const bool round = s.roundCurves && !findParam(r.params, "N");
  return (round ? makeTubes : makeCurves)(type == "cubic", s.vBasis, r.args[1].integers, isPeriodic(wrap, problems),
                                          r.params, problems);
}

}  // namespace tomales::rib

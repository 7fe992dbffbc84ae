#include "reyes/rib/contents.h"

#include "reyes/base/file_stamp.h"
#include "reyes/state_fields.h"

namespace tomales {

template <class A>
void fields(A& a, RibArg& x) {
  auto& [kind, numbers, strings, integers] = x;
  each(a, kind, numbers, strings, integers);
}

template <class A>
void fields(A& a, Request& x) {
  auto& [name, args, params, where, references] = x;
  each(a, name, args, params);
}

template <class A>
void fields(A& a, Basis& x) {
  auto& [matrix, step] = x;
  each(a, matrix, step);
}

template <class A>
void fields(A& a, NurbsDirection& x) {
  auto& [controls, order, knots, min, max] = x;
  each(a, controls, order, knots, min, max);
}

template <class A>
void fields(A& a, TrimCurve& x) {
  auto& [line, controls] = x;
  each(a, line, controls);
}

template <class A>
void fields(A& a, TrimLoops& x) {
  auto& [loops, keepsInside] = x;
  each(a, loops, keepsInside);
}

}  // namespace tomales

namespace tomales::rib {

uint64_t contentsOf(const std::vector<const Request*>& keys, const std::vector<float>& times, const Scope& scope) {
  uint64_t sum = contentSum(times, scope.uBasis, scope.vBasis, scope.roundCurves, *scope.trim);
  for (const Request* key : keys) {
    sum = contentSum(sum, *key);
    // The contents of brick maps and volumes are in their files.
    const Param* file = key->name == "Geometry" ? findParam(key->params, "filename") : nullptr;
    if (file && !file->strings.empty()) sum = contentSum(sum, fileStamp(file->strings[0]));
    const Param* volume = key->name == "Volume" ? findParam(key->params, kVolumeStrings) : nullptr;
    if (volume && !volume->strings.empty()) sum = contentSum(sum, fileStamp(volume->strings[0]));
    if (key->name == "Blobby" && key->args.size() > 3)
      for (const std::string& ground : key->args[3].strings) sum = contentSum(sum, fileStamp(ground));
  }
  return sum;
}

}  // namespace tomales::rib

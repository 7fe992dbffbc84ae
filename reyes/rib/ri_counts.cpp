#include "reyes/rib/ri_counts.h"

#include <algorithm>

namespace tomales::rib {
namespace {

size_t pastLargest(const RtInt list[], size_t length) {
  return length == 0 ? 0 : count(*std::max_element(list, list + length)) + 1;
}

/// Patches and their ends along one direction (RISpec 3.2 section 5.2).
struct Spans {
  size_t patches, ends;
};
Spans spans(bool cubic, RtInt n, RtToken wrap, int step) {
  const bool periodic = wrap && std::string_view(wrap) == RI_PERIODIC;
  const int order = cubic ? 4 : 2, by = cubic ? std::max(1, step) : 1;
  const size_t patches = periodic ? count(n / by) : n < order ? 0 : count((n - order) / by + 1);
  return {patches, patches + !periodic};
}

}  // namespace

size_t sum(const RtInt n[], RtInt length) {
  size_t out = 0;
  for (RtInt i = 0; i < length; ++i) out += count(n[i]);
  return out;
}

ValueCounts meshCounts(RtToken type, RtInt nu, RtToken uwrap, RtInt nv, RtToken vwrap,
                       const std::array<int, 2>& steps) {
  const Spans u = spans(isCubic(type), nu, uwrap, steps[0]), v = spans(isCubic(type), nv, vwrap, steps[1]);
  return {u.patches * v.patches, u.ends * v.ends, count(nu) * count(nv), u.ends * v.ends};
}

ValueCounts curveCounts(RtToken type, RtInt ncurves, const RtInt nvertices[], RtToken wrap, int step) {
  size_t varying = 0;
  for (RtInt i = 0; i < ncurves; ++i) varying += spans(isCubic(type), nvertices[i], wrap, step).ends;
  return {count(ncurves), varying, sum(nvertices, ncurves), varying};
}

ValueCounts faceCounts(RtInt nfaces, size_t corners, const RtInt vertices[]) {
  const size_t n = pastLargest(vertices, corners);
  return {count(nfaces), n, n, corners};
}

}  // namespace tomales::rib

// Reads TrimCurve (RISpec 3.2 section 5.2): nine flat arrays become loops of curves.
#include <fmt/format.h>

#include "reyes/rib/handlers.h"

namespace tomales::rib {
namespace {

/// Takes the arrays of the request apart, in order. Throws PrimError where one is too short.
class TrimArrays {
 public:
  explicit TrimArrays(const Request& r) : request_(r) {}

  /// Returns the next `n` values of array k.
  std::vector<float> take(size_t k, size_t n) { return take(request_.args[k].numbers, k, n); }
  size_t takeCount(size_t k) {
    const int n = take(request_.args[k].integers, k, 1)[0];
    if (n < 0 || n > 1'000'000) throw PrimError(fmt::format("array {} holds the count {}", k + 1, n));
    return static_cast<size_t>(n);
  }
  bool allTaken() const {
    for (size_t k = 0; k < 9; ++k)
      if (used_[k] < request_.args[k].numbers.size() + request_.args[k].integers.size()) return false;
    return true;
  }

 private:
  template <class T>
  std::vector<T> take(const std::vector<T>& all, size_t k, size_t n) {
    if (n > all.size() - used_[k])
      throw PrimError(fmt::format("array {} has {} values, too few for its curves", k + 1, all.size()));
    const auto first = all.begin() + static_cast<ptrdiff_t>(used_[k]);
    used_[k] += n;
    return {first, first + static_cast<ptrdiff_t>(n)};
  }

  const Request& request_;
  size_t used_[9] = {};
};

// The arrays are: curves of each loop; order, knots, min, max, controls of each curve; u w, v w, w of each control.
TrimCurve takeCurve(TrimArrays& arrays) {
  const size_t order = arrays.takeCount(1), controls = arrays.takeCount(5);
  TrimCurve curve;
  curve.line = {static_cast<int>(controls), static_cast<int>(order), arrays.take(2, controls + order),
                arrays.take(3, 1)[0], arrays.take(4, 1)[0]};
  const std::vector<float> u = arrays.take(6, controls), v = arrays.take(7, controls), w = arrays.take(8, controls);
  for (size_t i = 0; i < controls; ++i) curve.controls.emplace_back(u[i], v[i], w[i]);
  return curve;
}

}  // namespace

void trimCurve(GraphicsState& s, const Request& r) {
  TrimLoops trim{{}, s.scope.trim->keepsInside};
  TrimArrays arrays(r);
  try {
    trim.loops.resize(r.args[0].integers.size());
    for (auto& loop : trim.loops)
      for (size_t left = arrays.takeCount(0); left > 0; --left) loop.push_back(takeCurve(arrays));
    if (!arrays.allTaken()) s.warn(r, "rib-trim", "some arrays have more values than its curves need");
  } catch (const PrimError& e) {
    s.warn(r, "rib-trim", fmt::format("{}; what follows is not trimmed", e.what()));
    trim.loops.clear();
  }
  s.scope.trim = std::make_shared<TrimLoops>(std::move(trim));
}

}  // namespace tomales::rib

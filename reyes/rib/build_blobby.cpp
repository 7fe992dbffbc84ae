// Blobby requests, and Points of type "blobby" -> Prims.
#include <fmt/format.h>

#include "reyes/rib/geometry_builders.h"

namespace tomales::rib {
namespace {

constexpr int kAdd = 0, kConstant = 1000, kEllipsoid = 1001;

RibArg integers(std::vector<int> list) { return {.kind = RibArg::Kind::Integers, .integers = std::move(list)}; }

}  // namespace

PrimPtr blobby(const Request& r, const Prim* first, Problems& problems) {
  const int leaves = r.args[0].integer();
  const std::vector<int>& code = r.args[1].integers;
  const std::vector<float>& floats = r.args[2].numbers;
  return first ? makeBlobbyKey(*first, leaves, code, floats, r.params, problems) : makeBlobby(leaves, code, floats, r.params, problems);
}

// A lone ellipsoid shows at half its radius, so each is as large as its point is wide. Where a point has no width there is nothing.
std::optional<Request> blobbyOfPoints(const Request& r) {
  const Param* type = r.name == "Points" ? findParam(r.params, "type") : nullptr;
  if (!type || type->strings.empty() || type->strings[0] != "blobby") return std::nullopt;
  const Param* place = findParam(r.params, "P");
  if (!place) return std::nullopt;
  const Param* width = findParam(r.params, "width");
  if (!width) width = findParam(r.params, "constantwidth");
  const size_t n = place->floats.size() / 3;
  if (width && width->floats.size() != 1 && width->floats.size() != n)
    throw PrimError(fmt::format("{} has {} values for {} points", width->name, width->floats.size(), n));
  std::vector<int> code, sum{kAdd, static_cast<int>(n)};
  std::vector<float> floats;
  for (size_t i = 0; i < n; ++i) {
    const float w = width ? width->floats[width->floats.size() > 1 ? i : 0] : 1;
    const float* p = &place->floats[3 * i];
    if (!(w >= 0)) throw PrimError(fmt::format("{} is {} somewhere", width->name, w));
    code.insert(code.end(), {w > 0 ? kEllipsoid : kConstant, static_cast<int>(floats.size())});
    floats.insert(floats.end(), {w, 0, 0, 0, 0, w, 0, 0, 0, 0, w, 0, p[0], p[1], p[2], 1});
    sum.push_back(static_cast<int>(i));
  }
  code.insert(code.end(), sum.begin(), sum.end());
  Request out{.name = "Blobby", .args = {integers({static_cast<int>(n)}), integers(std::move(code))}, .params = r.params, .where = r.where};
  out.args.push_back({.kind = RibArg::Kind::Numbers, .numbers = std::move(floats)});
  std::erase_if(out.params, [](const Param& p) { return p.name == "P" || p.name == "type" || p.name == "width" || p.name == "constantwidth"; });
  return out;
}

}  // namespace tomales::rib

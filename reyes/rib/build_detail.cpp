// Level of detail (RISpec 3.2 section 4.2.8): the size of a box in the picture decides which representations are drawn.
#include <fmt/format.h>

#include "reyes/rib/handlers.h"

namespace tomales::rib {
namespace {

/// Returns the area of the rectangle around the box in the picture, not cut off by its frame; infinite where the box
/// reaches the eye.
float size_px2(const GraphicsState& s, const std::vector<float>& b) {
  const Camera camera(s.globals.options);
  const mat4 m = s.cameraFromObject().at(s.globals.options.shutterOpen);
  Bound2 raster;
  for (int i = 0; i < 8; ++i) {
    const vec3 p = transformPoint(m, Bound3{{b[0], b[2], b[4]}, {b[1], b[3], b[5]}}.corner(i));
    if (!tomales::isFinite(p) || (camera.perspective() && p.z < camera.nearClip())) return kInfinity;
    raster.extend(camera.raster(p));
  }
  const vec2 size = raster.hi - raster.lo;
  return size.x * size.y;
}

/// Returns the share of a range. Both shares of a transition are computed from the same numbers, so that they add up to
/// all samples.
DetailShare shareOf(const std::array<float, 4>& range, float ruler) {
  const auto [least, lower, upper, most] = range;
  if (ruler < least || (ruler >= most && most < kRiInfinity)) return {0, 0};
  if (ruler < lower) return {(lower - ruler) / (lower - least), 1};
  if (ruler > upper && most < kRiInfinity) return {0, (most - ruler) / (most - upper)};
  return {};
}

void apply(Scope& s) {
  const DetailShare& whole = s.detail.divided;
  const DetailShare part = s.detail.range ? shareOf(*s.detail.range, s.detail.ruler_px2) : DetailShare{};
  const DetailShare share{lerp(whole.lo, whole.hi, part.lo), lerp(whole.lo, whole.hi, part.hi)};
  if (share != s.attributes->detail) s.edit().detail = share;
}

void detail(GraphicsState& s, const Request& r) {
  const float size = size_px2(s, r.args[0].numbers);
  const float factor = s.globals.options.relativeDetail;
  s.scope.detail.ruler_px2 = factor > 0 ? size * factor : 0;
  s.scope.detail.divided = s.scope.detail.left;
  apply(s.scope);
}

void detailRange(GraphicsState& s, const Request& r) {
  const std::vector<float>& a = r.args[0].numbers;
  if (!std::is_sorted(a.begin(), a.end()))
    return s.warn(
        r, "rib-attribute",
        fmt::format("{} {} {} {} does not increase; the attribute is left as it was", a[0], a[1], a[2], a[3]));
  s.scope.detail.range = {a[0], a[1], a[2], a[3]};
  apply(s.scope);
}

}  // namespace

const HandlerTable& detailHandlers() {
  static const HandlerTable table = {{"Detail", detail}, {"DetailRange", detailRange}};
  return table;
}

}  // namespace tomales::rib

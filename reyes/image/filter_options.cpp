// Checks the filters of the Options, and finds how far they reach.
#include "reyes/image.h"

namespace tomales {

vec2 filterReach(const Options& options) {
  vec2 reach(0.0f);
  const FrameOutput output = outputOf(options);
  for (const Channel& channel : output.channels) {
    const Sampling& s = channel.sampling;
    const PixelFilter filter(s.reduce == Reduce::Filter ? s.filter : "box", s.xWidth, s.yWidth);
    reach = glm::max(reach, vec2(filter.reachX(), filter.reachY()));
  }
  return reach;
}

PixelRect grownByFilter(const PixelRect& rect, const Options& options) {
  const vec2 reach = filterReach(options);
  const int x = static_cast<int>(reach.x), y = static_cast<int>(reach.y);
  return {rect.x0 - x, rect.y0 - y, rect.x1 + x, rect.y1 + y};
}

bool checkDisplays(const Options& options, Log& log) {
  const FrameOutput output = outputOf(options, &log);
  bool good = true;
  const auto check = [&](const std::string& name, const SourceLoc& where, const std::string& who) {
    bool known = true;
    PixelFilter(name, 2, 2, &known);
    if (!known)
      log.report(Severity::Warning, "filter-unknown", where, who + ": no filter \"" + name + "\"; gaussian is used");
    good = good && known;
  };
  check(options.filter, {}, "PixelFilter");
  for (const Channel& c : output.channels)
    if (c.kind == ChannelKind::Variable && c.sampling.reduce == Reduce::Filter)
      check(c.sampling.filter, output.variables[static_cast<size_t>(c.variable)].where, "channel \"" + c.name + "\"");
  return good;
}

}  // namespace tomales

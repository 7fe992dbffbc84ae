// Displays, their channels, and the hider (RISpec 3.2 section 4.1.3; PRMan's DisplayChannel).
#include <fmt/format.h>

#include "reyes/rib/dictionary.h"
#include "reyes/rib/handlers.h"

namespace tomales::rib {
namespace {

void quantize(GraphicsState& s, const Request& r) {
  const std::vector<float>& a = r.args[1].numbers;
  const Quantize q{a[0], a[1], a[2], a[3]};
  const std::string& type = r.args[0].strings[0];
  if (type == "rgba" || type == "rgb") {
    s.globals.options.rgbaQuantize = q;
    s.globals.options.quantizeGiven = true;
  } else if (type == "z") {
    s.globals.options.depthQuantize = q;
  } else {
    s.warn(r, "rib-option", "quantization of \"" + type + "\" is not supported yet; ignored");
  }
}

// RISpec 3.2: a leading '+' adds a display, any other replaces them all.
void display(GraphicsState& s, const Request& r) {
  DisplayCall call{r.args[0].strings[0], r.args[1].strings[0], r.args[2].strings[0], r.params, r.where};
  const bool adds = !call.name.empty() && call.name[0] == '+';
  if (adds)
    call.name.erase(0, 1);
  else
    s.globals.options.displays.clear();
  s.globals.options.displays.push_back(std::move(call));
}

// "class type name": the type is that of the variable, the class tells nothing.
void displayChannel(GraphicsState& s, const Request& r) {
  static const Dictionary standard;
  ChannelCall call{"", ValueType::Color, r.params, r.where};
  const std::string& token = r.args[0].strings[0];
  if (const auto declaration = standard.find(token, "", call.name)) {
    call.type = declaration->type == ValueType::Integer ? ValueType::Float : declaration->type;
    if (declaration->arrayLength != 1 || floatsPerValue(call.type) > 3 || call.type == ValueType::String)
      return s.warn(r, "rib-channel", fmt::format("\"{}\" is of a type that no picture holds; ignored", token));
  } else {
    call.name = token;
    s.warn(r, "rib-channel", fmt::format("\"{}\" has no type; taken for a color", token));
  }
  static constexpr std::string_view kKnown[] = {"quantize", "dither", "fill", "filter", "filterwidth", "exposure", "source"};
  for (const Param& p : r.params)
    if (std::find(std::begin(kKnown), std::end(kKnown), p.name) == std::end(kKnown))
      s.warnOnce("channel:" + p.name, r, "rib-channel", "DisplayChannel: no parameter \"" + p.name + "\"; ignored");
  s.globals.options.channels[call.name] = std::move(call);
}

void depthFilter(GraphicsState& s, const Request& r, const std::string& name) {
  static constexpr std::pair<std::string_view, DepthFilter> kNames[] = {{"min", DepthFilter::Min},
                                                                        {"max", DepthFilter::Max},
                                                                        {"average", DepthFilter::Average},
                                                                        {"midpoint", DepthFilter::Midpoint}};
  for (const auto& [known, filter] : kNames)
    if (known == name) return void(s.globals.options.depthFilter = filter);
  s.warn(r, "rib-option", "unknown depthfilter \"" + name + "\"; the option is left as it was");
}

void hider(GraphicsState& s, const Request& r) {
  Options& o = s.globals.options;
  o.hider = r.args[0].strings[0];
  for (const Param& p : r.params)
    if (p.name == "jitter")
      o.jitter = p.number(1) != 0;
    else if (p.name == "samplemotion")
      o.sampleMotion = p.number(1) != 0;
    else if (p.name == "dofaspect" && p.number(1) > 0)
      o.dofAspect = clamped(s, r, p.number(1), 0.01f, 100);
    else if (p.name == "aperture" && p.floats.size() == 4)
      o.aperture = {clamped(s, r, p.floats[0], 0, 64), p.floats[1], clamped(s, r, p.floats[2], -1, 1),
                    clamped(s, r, p.floats[3], -1, 1)};
    else if (p.name == "depthfilter" && !p.strings.empty())
      depthFilter(s, r, p.strings[0]);
    else
      s.warnOnce("hider:" + p.name, r, "rib-unsupported",
                 "Hider: parameter \"" + p.name + "\" is not supported or has no such value, ignored");
}

}  // namespace

const HandlerTable& displayHandlers() {
  static const HandlerTable table = {
      {"Quantize", quantize}, {"Display", display}, {"DisplayChannel", displayChannel}, {"Hider", hider}};
  return table;
}

}  // namespace tomales::rib

// Displays, their channels, and the hider (RISpec 3.2 section 4.1.3; PRMan's DisplayChannel).
#include <fmt/format.h>

#include "reyes/display_mode.h"
#include "reyes/rib/dictionary.h"
#include "reyes/rib/handlers.h"
#include "reyes/rib/refusals.h"
#include "reyes/rib/ris.h"
#include "reyes/surface_variables.h"

namespace tomales::rib {
namespace {

Param floats(const char* name, std::vector<float> values) {
  Param p;
  p.name = name;
  p.arrayLength = static_cast<int>(values.size());
  p.floats = std::move(values);
  return p;
}

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
    s.globals.quantized[type] = {floats("quantize", {0, q.one, q.min, q.max}), floats("dither", {q.dither})};
  }
}

const Dictionary& standardNames() {
  static const Dictionary dictionary;
  return dictionary;
}

// Returns the type if a picture can hold it, and nothing otherwise.
std::optional<ValueType> channelType(const Declaration& d) {
  const ValueType type = d.type == ValueType::Integer ? ValueType::Float : d.type;
  const bool fits = d.arrayLength == 1 && floatsPerValue(type) <= 3 && type != ValueType::String;
  return fits ? std::optional(type) : std::nullopt;
}

// Declares the variable that a mode "float name" shows, as BMRT and Aqsis do, and those that Declare has declared:
// before PRMan 11 there was no DisplayChannel.
void declareChannels(GraphicsState& s, DisplayCall& call) {
  const auto declare = [&](const std::string& token) {
    std::string name;
    const auto declaration = standardNames().find(token, "", name);
    const auto type = declaration ? channelType(*declaration) : std::nullopt;
    if (!type || name == token) return std::string();
    s.globals.options.channels.try_emplace(name, ChannelCall{name, *type, {}, call.where});
    return name;
  };
  if (const std::string name = declare(call.mode); !name.empty()) call.mode = name;
  for (const std::string& name : channelNames(call.mode))
    if (const auto it = s.declared.find(name); it != s.declared.end() && !isOfLetters(name) && !surfaceVariable(name))
      declare(it->second + ' ' + name);
}

// Adds a display. By RISpec 3.2 a name with a leading '+' adds one, and any other replaces them all.
void display(GraphicsState& s, const Request& r) {
  DisplayCall call{r.args[0].strings[0], r.args[1].strings[0], r.args[2].strings[0], r.params, r.where};
  const bool adds = !call.name.empty() && call.name[0] == '+';
  if (adds)
    call.name.erase(0, 1);
  else
    s.globals.options.displays.clear();
  if (call.name.find_last_not_of("./") == std::string::npos) {  // such a name is all extension
    s.warn(r, "rib-display", "\"" + call.name + "\" names no file; ri.pic, the default of RenderMan, is used");
    call.name = DisplayCall().name;
  }
  declareChannels(s, call);
  if (const auto it = s.globals.quantized.find(call.mode);
      it != s.globals.quantized.end() && !findParam(call.params, "quantize"))
    call.params.insert(call.params.end(), it->second.begin(), it->second.end());
  s.globals.options.displays.push_back(std::move(call));
}

// "class type name" gives the type of the variable; the class does not matter. A name alone has the type that Declare
// or the renderer has given it.
void displayChannel(GraphicsState& s, const Request& r) {
  std::string token = r.args[0].strings[0];
  ChannelCall call{token, ValueType::Color, r.params, r.where};
  if (const auto it = s.declared.find(token); it != s.declared.end()) token = it->second + ' ' + token;
  if (const auto declaration = standardNames().find(token, "", call.name)) {
    const auto type = channelType(*declaration);
    call.type = type.value_or(call.type);
    if (!type)
      return s.warn(r, "rib-channel", fmt::format("\"{}\" is of a type that no picture holds; ignored", token));
  } else if (const SurfaceVariable* standard = surfaceVariable(token)) {
    call.name = token;
    call.type = standard->type;
  } else if (token.find(' ') != std::string::npos) {
    return s.warn(r, "rib-channel", fmt::format("\"{}\" is no declaration of a channel; ignored", token));
  } else {
    call.name = token;
    s.warn(r, "rib-channel", fmt::format("\"{}\" has no type; taken for a color", token));
  }
  static constexpr std::string_view kKnown[] = {"quantize",    "dither",   "fill",  "filter",
                                                "filterwidth", "exposure", "source"};
  for (const Param& p : r.params)
    if (std::find(std::begin(kKnown), std::end(kKnown), p.name) == std::end(kKnown))
      s.warnOnce("channel:" + p.name, r, "rib-channel", "DisplayChannel: no parameter \"" + p.name + "\"; ignored");
  for (Param& p : call.params)
    if (p.name == "source" && !p.strings.empty()) p.strings[0] = risSource(p.strings[0]);
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
  if (o.hider != "hidden" && o.hider != "stochastic") {
    const std::string reason = reasonFor("Hider " + o.hider);
    s.warnOnce("hider " + o.hider, r, "rib-unsupported",
               "Hider \"" + o.hider + "\" is not supported" +
                   (reason.empty() ? ": the picture is rendered as by \"hidden\"" : reason));
  }
  for (const Param& p : r.params)
    if (p.name == "jitter")
      o.jitter = p.number(1) != 0;
    else if (p.name == "samplemotion")
      o.sampleMotion = p.number(1) != 0;
    else if (p.name == "maxsamples" && o.hider == "raytrace" && p.number(0) > 0)
      o.xSamples = o.ySamples =
          static_cast<int>(std::ceil(std::sqrt(std::min<float>(p.number(0), kMostTracedSamples))));
    else if (p.name == "dofaspect" && p.number(1) > 0)
      o.dofAspect = clamped(s, r, p.number(1), 0.01f, 100);
    else if (p.name == "aperture" && p.floats.size() == 4)
      o.aperture = {clamped(s, r, p.floats[0], 0, 64), p.floats[1], clamped(s, r, p.floats[2], -1, 1),
                    clamped(s, r, p.floats[3], -1, 1)};
    else if (p.name == "depthfilter" && !p.strings.empty())
      depthFilter(s, r, p.strings[0]);
    else
      s.warnOnce("hider:" + p.name, r, "rib-unsupported",
                 "Hider: parameter \"" + p.name + "\" is not supported or has no such value, ignored" +
                     reasonFor("Hider:" + p.name));
}

}  // namespace

const HandlerTable& displayHandlers() {
  static const HandlerTable table = {
      {"Quantize", quantize}, {"Display", display}, {"DisplayChannel", displayChannel}, {"Hider", hider}};
  return table;
}

}  // namespace tomales::rib

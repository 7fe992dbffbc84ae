#include "reyes/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "reyes/display_mode.h"

namespace tomales {
namespace {

/// A request whose parameters say how a channel is written.
struct Asker {
  std::string name;  ///< Name for messages.
  const ParamList& params;
  const SourceLoc& where;
};

const std::map<std::string, Reduce, std::less<>> kReductions = {{"zmin", Reduce::ZMin},
                                                                {"zmax", Reduce::ZMax},
                                                                {"min", Reduce::Min},
                                                                {"max", Reduce::Max},
                                                                {"average", Reduce::Average}};

/// Sets the sampling and encoding that the request's parameters give, and keeps all others.
void amend(Channel& channel, Encoding& encoding, const Asker& asker, Log* log) {
  const auto numbers = [&](const char* name, size_t count) -> std::optional<std::vector<float>> {
    const Param* p = findParam(asker.params, name);
    if (!p) return std::nullopt;
    if (p->floats.size() == count) return p->floats;
    if (p->ints.size() == count)
      return std::vector<float>(p->ints.begin(), p->ints.end());  // RenderMan for Maya: "int[4] quantize"
    if (log)
      log->report(Severity::Warning, "channel-parameter", asker.where,
                  fmt::format("{}: \"{}\" needs {} numbers; ignored", asker.name, name, count));
    return std::nullopt;
  };
  const Param* filter = findParam(asker.params, "filter");
  const auto width = numbers("filterwidth", 2);
  if (channel.kind == ChannelKind::Variable && filter && !filter->strings.empty()) {
    const auto it = kReductions.find(filter->strings[0]);
    channel.sampling.reduce = it == kReductions.end() ? Reduce::Filter : it->second;
    if (it == kReductions.end())
      channel.sampling.filter = filter->strings[0];
    else
      channel.sampling.xWidth = channel.sampling.yWidth = 1;  // only the pixel's own samples count
  }
  if (channel.kind == ChannelKind::Variable && width) {
    channel.sampling.xWidth = (*width)[0];
    channel.sampling.yWidth = (*width)[1];
  }
  if ((filter || width) && channel.kind != ChannelKind::Variable && log)
    log->report(Severity::Warning, "channel-filter", asker.where,
                fmt::format("{}: Ci and a are filtered by PixelFilter, z by the Hider's depthfilter; \"filter\" is "
                            "ignored for them",
                            asker.name));
  if (const auto exposure = numbers("exposure", 2)) {
    if ((*exposure)[1] > 0)
      encoding.exposure = {(*exposure)[0], (*exposure)[1]};
    else if (log)
      log->report(Severity::Warning, "channel-exposure", asker.where, asker.name + ": gamma must be positive; ignored");
  }
  const auto quantize = numbers("quantize", 4), dither = numbers("dither", 1);
  if (quantize) encoding.quantize = Quantize{(*quantize)[1], (*quantize)[2], (*quantize)[3], 0, (*quantize)[0]};
  if (dither) {
    if (!encoding.quantize) encoding.quantize = Quantize{};
    encoding.quantize->dither = (*dither)[0];
  }
}

class Planner {
 public:
  Planner(const Options& options, Log* log) : options_(options), log_(log) {
    const Sampling main{Reduce::Filter, options.filter, options.xFilterWidth, options.yFilterWidth};
    addChannel({"Ci", ChannelKind::Color, ValueType::Color, -1, true, main, 0, 0});
    addChannel({"a", ChannelKind::Alpha, ValueType::Float, -1, true, main, 0, 0});
    addChannel({"z", ChannelKind::Depth, ValueType::Float, -1, false, main, 0, 0});
  }

  FrameOutput plan() {
    for (const DisplayCall& display : options_.displays) addDisplay(display);
    out_.shades = shades(options_);
    return std::move(out_);
  }

 private:
  void addDisplay(const DisplayCall& display) {
    Selection selection;
    const std::string mode = writesShadowMap(display) ? "z" : display.mode;
    if (!writesDeep(display))
      for (const std::string& name : channelNames(mode)) selectNamed(name, mode, display, selection);
    if (selection.empty() && !writesDeep(display)) {
      warn(display, "display-mode", fmt::format("no channels \"{}\"; rgba is written", display.mode));
      for (const char* name : {"Ci", "a"}) select(name, display, selection);
    }
    out_.displays.push_back(std::move(selection));
  }

  /// Selects a channel, or the letters of a mode "bar" unless that is a channel. In a list, as in "rgba,diffuse", only
  /// single ones and those of colour and opacity are letters.
  void selectNamed(const std::string& name, const std::string& mode, const DisplayCall& display, Selection& selection) {
    const bool letters = isOfLetters(name) && (name == mode || name.size() == 1 || name.starts_with("rgb"));
    if (!letters || options_.channels.contains(name)) return select(name, display, selection);
    for (const char letter : name) select(std::string(1, letter), display, selection, true);
  }

  /// asLetter: "r", "g" and "b" mean Ci, even if channels have these names.
  void select(const std::string& name, const DisplayCall& display, Selection& selection, bool asLetter = false) {
    static const std::string kLetters = "rgb";
    const bool letter = asLetter && kLetters.find(name[0]) != std::string::npos;
    Encoding encoding;
    const int channel = letter ? channelNamed("Ci", display, encoding) : channelNamed(name, display, encoding);
    if (channel < 0) return;
    const Channel& c = out_.channels[static_cast<size_t>(channel)];
    for (int k = 0; k < c.width(); ++k)
      if (!letter || kLetters[static_cast<size_t>(k)] == name[0])
        selection.push_back({channel, k, floatName(letter ? "Ci" : name, c, k), encoding});
  }

  static std::string floatName(const std::string& name, const Channel& c, int component) {
    static constexpr const char *kColor[] = {"R", "G", "B"}, *kVector[] = {"X", "Y", "Z"};
    static constexpr const char* kRanks[] = {"R", "G", "B", "A"};
    if (isMatte(c.kind)) return fmt::format("{}{:02}.{}", matteLayer(c.kind), component / 4, kRanks[component % 4]);
    if (name == "Ci") return kColor[component];
    if (name == "a" || name == "alpha") return "A";
    if (name == "z") return "Z";
    if (c.width() == 1) return name;
    return name + "." + (c.type == ValueType::Color ? kColor : kVector)[component];
  }

  /// Returns -1 if there is no such channel, which has been reported.
  int channelNamed(const std::string& name, const DisplayCall& display, Encoding& encoding) {
    const auto declared = options_.channels.find(name);
    const bool isDeclared = declared != options_.channels.end();
    const SurfaceVariable* standard = surfaceVariable(name);
    if (!isDeclared && !standard) {
      warn(display, "display-channel",
           fmt::format("\"{}\" has not been declared by DisplayChannel; it is left out", name));
      return -1;
    }
    Channel channel;
    channel.name = name;
    channel.type = isDeclared ? declared->second.type : standard->type;
    const Param* given = isDeclared ? findParam(declared->second.params, "source") : nullptr;
    const std::string source = given && !given->strings.empty() ? given->strings[0] : name;
    const SurfaceVariable* shown = surfaceVariable(source);
    if (shown && shown->kind != ChannelKind::Variable) {
      channel.kind = shown->kind;
      channel.type = shown->type;
    }
    channel.composited = channel.type == ValueType::Color || channel.kind == ChannelKind::Alpha;
    channel.sampling = {Reduce::Filter, options_.filter, options_.xFilterWidth, options_.yFilterWidth};
    if (isDeclared) {
      if (const Param* fill = findParam(declared->second.params, "fill")) channel.fill = fill->number(0);
      amend(channel, encoding, {"DisplayChannel \"" + name + "\"", declared->second.params, declared->second.where},
            log_);
    }
    amend(channel, encoding, {"Display \"" + display.name + "\"", display.params, display.where}, log_);
    if (channel.kind == ChannelKind::Variable)
      channel.variable =
          variable({source, channel.type, channel.fill, 0, isDeclared ? declared->second.where : display.where});
    return addChannel(std::move(channel));
  }

  int variable(Variable wanted) {
    for (size_t i = 0; i < out_.variables.size(); ++i) {
      const Variable& v = out_.variables[i];
      if (v.source == wanted.source && v.type == wanted.type && v.fill == wanted.fill) return static_cast<int>(i);
    }
    wanted.first = out_.floatsPerPoint;
    out_.floatsPerPoint += floatsPerValue(wanted.type);
    out_.variables.push_back(std::move(wanted));
    return static_cast<int>(out_.variables.size()) - 1;
  }

  int addChannel(Channel wanted) {
    for (size_t i = 0; i < out_.channels.size(); ++i)
      if (same(out_.channels[i], wanted)) return static_cast<int>(i);
    wanted.first = out_.channels.empty() ? 0 : out_.channels.back().first + out_.channels.back().width();
    out_.floatsPerPixel = wanted.first + wanted.width();
    out_.channels.push_back(std::move(wanted));
    return static_cast<int>(out_.channels.size()) - 1;
  }

  static bool same(const Channel& a, const Channel& b) {
    return a.kind == b.kind &&
           (a.kind != ChannelKind::Variable || (a.variable == b.variable && a.sampling == b.sampling));
  }

  void warn(const DisplayCall& display, const char* code, const std::string& what) const {
    if (log_) log_->report(Severity::Warning, code, display.where, "Display \"" + display.name + "\": " + what);
  }

  const Options& options_;
  Log* log_;
  FrameOutput out_;
};

}  // namespace

std::vector<std::string> FrameOutput::names() const {
  std::vector<std::string> out{"R", "G", "B", "A", "Z"};
  for (const Channel& c : channels)
    for (int k = 0; c.first >= 5 && k < c.width(); ++k) out.push_back(fmt::format("{}.{}", c.name, k));
  return out;
}

bool shades(const Options& options) {
  return options.displays.empty() ||
         std::any_of(options.displays.begin(), options.displays.end(),
                     [](const DisplayCall& d) { return !writesMap(d) && d.mode != "z" && d.type != "null"; });
}

FrameOutput outputOf(const Options& options, Log* log) { return Planner(options, log).plan(); }

namespace {

/// Types of Displays that decide what is written, and not only the format.
struct MapType {
  std::string_view name;
  bool deep;   ///< It has a list of depths in every pixel.
  bool shows;  ///< It has colours too.
};
constexpr MapType kMapTypes[] = {
    {"shadow", false, false}, {"zfile", false, false}, {"deepshad", true, false}, {"deepexr", true, true}};

const MapType* mapType(const DisplayCall& display) {
  const auto* it = std::find_if(std::begin(kMapTypes), std::end(kMapTypes),
                                [&](const MapType& t) { return t.name == display.type; });
  return it == std::end(kMapTypes) ? nullptr : it;
}

}  // namespace

bool writesMap(const DisplayCall& display) {
  const MapType* type = mapType(display);
  return type && !type->shows;
}

bool writesShadowMap(const DisplayCall& display) { return writesMap(display) && !writesDeep(display); }

bool writesDeep(const DisplayCall& display) {
  const MapType* type = mapType(display);
  return type && type->deep;
}

}  // namespace tomales

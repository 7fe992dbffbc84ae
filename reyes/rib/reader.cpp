#include "reyes/rib/reader.h"

#include <fmt/format.h>

#include <filesystem>

#include "reyes/base/stop.h"
#include "reyes/rib/variables.h"

namespace tomales::rib {
namespace {

SourceLoc wholeFile(const std::string& name) { return {std::make_shared<const std::string>(name), 0}; }

/// Tells whether the request changes more than the state that AttributeBegin saves.
bool changesProceduralContext(std::string_view name) {
  static constexpr std::string_view kNames[] = {
      "Declare", "ColorSamples", "ObjectEnd", "Option",        "CoordinateSystem", "LightSource", "AreaLightSource",
      "Light",   "Pattern",      "Resource",  "ResourceBegin", "ResourceEnd",      "WorldBegin",  "WorldEnd"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

}  // namespace

void declare(const Request& r, Dictionary& dictionary, Log& log) {
  if (r.name == "ColorSamples") {
    if (r.args[0].numbers.size() != r.args[1].numbers.size() || !dictionary.setColorSamples(r.args[0].numbers))
      log.report(Severity::Warning, "rib-option", r.where,
                 fmt::format("ColorSamples: two matrices of 3 times up to {} numbers are needed; ignored",
                             Dictionary::kMostColorSamples));
  }
  if (r.name != "Declare") return;
  const std::string &name = r.args[0].strings[0], &declaration = r.args[1].strings[0];
  if (!dictionary.declare(name, declaration))
    log.report(Severity::Warning, "rib-declaration", r.where,
               fmt::format("Declare: \"{}\" is no declaration of \"{}\"; ignored", declaration.substr(0, 80),
                           name.substr(0, 80)));
}

bool Reader::readFile(const std::string& path) {
  const auto stream = ByteStream::open(path);
  if (stream) return readTop(*stream, path == "-" ? "standard input" : path);
  log_.report(Severity::Error, "rib-open", wholeFile(path), ByteStream::refusal(path));
  return false;
}

bool Reader::readText(const std::string& text, const std::string& name) {
  return readTop(*ByteStream::fromMemory(text), name);
}

bool Reader::readTop(ByteStream& stream, const std::string& name) {
  last_ = wholeFile(name);
  std::error_code error;
  const std::filesystem::path path = std::filesystem::weakly_canonical(name, error);
  if (read(stream, name, error ? name : path.string(), std::filesystem::path(name).parent_path()) > 0) return true;
  log_.report(Severity::Error, "rib-empty", wholeFile(name), "the file holds no RIB request that could be read");
  return false;
}

size_t Reader::read(ByteStream& stream, const std::string& name, const std::string& key, const std::string& folder,
                    size_t cost) {
  enter(key, folder);
  Parser parser(stream, name, dictionary_, log_);
  size_t count = 0;
  for (std::optional<Request> request = parser.next(); request && (cost == 0 || spend(cost));
       request = parser.next(), ++count) {
    if (dictionary_.hasColorSamples()) *request = withRgb(std::move(*request));
    handle(*request);
    skip(*request, parser);
    parser.mute(!open_.back().conditions.reads());
  }
  if (stream.damaged())
    log_.report(Severity::Missing, "rib-gzip", wholeFile(name),
                "the compressed data is " + stream.damage() + "; what comes before is used");
  leave();
  return count;
}

void Reader::skip(const Request& r, Parser& parser) {
  const bool begins = r.name == "FrameBegin" && inFrame_ && open_.size() == 1;
  if (!begins || !settings_.skipsFrame || !settings_.skipsFrame(r.args[0].integer())) return;
  const int worlds = parser.skipFrame();
  if (settings_.onSkipped) settings_.onSkipped(worlds);
}

void Reader::tellOfOutliving(const Request& r) const {
  static constexpr std::string_view kNames[] = {"Declare", "ColorSamples", "ArchiveBegin", "System"};
  const bool outlives = std::find(std::begin(kNames), std::end(kNames), r.name) != std::end(kNames) ||
                        (r.name == "Option" && r.args[0].strings[0] == "ribparse") ||
                        (r.name == "WorldBegin" && open_.size() > 1);  // it would not be counted
  if (outlives && settings_.onOutliving) settings_.onOutliving(r);
}

void Reader::enter(const std::string& key, const std::string& folder) {
  proceduralContext_.reset();
  open_.push_back({key, folder, Conditions(log_, [this](const std::string& v) { return variable(v); }), {}});
}

void Reader::leave() {
  if (open_.back().recording) {
    report(Severity::Warning, "rib-unbalanced", open_.back().recording->begin, "ArchiveEnd is missing");
    endRecording();
  }
  open_.back().conditions.finish();
  open_.pop_back();
  proceduralContext_.reset();
}

void Reader::handle(const Request& r) {
  throwIfStopped();
  last_ = r.where;
  Level& level = open_.back();
  if (level.recording) return record(r);
  if (level.conditions.take(r)) return;
  if (!inProcedural_ && (r.name == "FrameBegin" || r.name == "FrameEnd")) inFrame_ = r.name == "FrameBegin";
  if (inFrame_) tellOfOutliving(r);
  if (mark_ != 0)
    perform(substituted(r));
  else
    perform(r);
}

void Reader::perform(const Request& r) {
  static const std::unordered_map<std::string_view, Performer> table = {
      {"ReadArchive", &Reader::readArchive}, {"ArchiveBegin", &Reader::record},     {"ArchiveEnd", &Reader::record},
      {"Procedural", &Reader::procedural},   {"Procedural2", &Reader::procedural2}, {"System", &Reader::system},
      {"Geometry", &Reader::geometry},       {"Blobby", &Reader::geometry},         {"Volume", &Reader::geometry}};
  if (const auto it = table.find(r.name); it != table.end()) return (this->*it->second)(r);
  if (changesProceduralContext(r.name)) proceduralContext_.reset();
  declare(r, dictionary_, log_);
  const Param* mark =
      r.name == "Option" && r.args[0].strings[0] == "ribparse" ? findParam(r.params, "varsubst") : nullptr;
  if (mark && !mark->strings.empty()) mark_ = mark->strings[0].empty() ? '\0' : mark->strings[0][0];
  builder_.request(r);
}

std::optional<std::string> Reader::variable(const std::string& name) const {
  return findVariable(builder_.options(), builder_.attributes(), name);
}

Request Reader::withRgb(Request r) const {
  if (r.name == "Color" || r.name == "Opacity") r.args[0].numbers = dictionary_.rgb(r.args[0].numbers);
  for (Param& p : r.params)
    if (p.type == ValueType::Color) p.floats = dictionary_.rgb(p.floats);
  return r;
}

// Replaces variables in strings that are values; names of parameters stay.
Request Reader::substituted(const Request& r) const {
  Request out = r;
  std::string unknown;
  const auto find = [this](const std::string& name) -> std::optional<std::string> {
    if (auto value = variable(name)) return value;
    const char* environment = std::getenv(name.c_str());
    return environment ? std::optional<std::string>(environment) : std::nullopt;
  };
  size_t bytes = 0;
  const auto replace = [&](std::vector<std::string>& strings) {
    for (std::string& s : strings) {
      if (s.find(mark_) == std::string::npos) continue;
      s = substitute(s, mark_, find, unknown);
      bytes += s.size();
      if (bytes > kLongestText)
        throw ExpressionError(fmt::format("its strings would be longer than {} bytes", kLongestText));
    }
  };
  try {
    for (RibArg& a : out.args) replace(a.strings);
    for (Param& p : out.params) replace(p.strings);
  } catch (const ExpressionError& e) {
    report(Severity::Warning, "rib-variable", r,
           fmt::format("with the values of variables {}; all of them are left as written", e.what()));
    return r;
  }
  // Search paths take variables of the environment in any case, and whoever replaces these reports what is left.
  const bool isReported = mark_ == '$' && r.name == "Option" && r.args[0].strings[0] == "searchpath";
  if (!unknown.empty() && !isReported)
    report(Severity::Warning, "rib-variable", r, fmt::format("there is no variable {}; left as written", unknown));
  return out;
}

void Reader::report(Severity severity, const char* code, const Request& r, const std::string& what) const {
  log_.report(severity, code, r.where, r.name + ": " + what);
}

}  // namespace tomales::rib

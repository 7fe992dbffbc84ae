#include "reyes/rib.h"

#include <filesystem>

#include "reyes/rib/parser.h"
#include "reyes/rib/reader.h"

namespace tomales {
namespace {

/// Parses streams that share one dictionary.
class PlainParse {
 public:
  PlainParse(RiSink& sink, Log& log) : sink_(sink), log_(log) {}

  bool read(rib::ByteStream* stream, const std::string& name) {
    const SourceLoc whole{std::make_shared<const std::string>(name), 0};
    if (!stream) {
      log_.report(Severity::Error, "rib-open", whole, rib::ByteStream::refusal(name));
      return false;
    }
    rib::Parser parser(*stream, name, dictionary_, log_);
    bool any = false;
    while (const std::optional<Request> request = parser.next()) {
      any = true;
      rib::declare(*request, dictionary_, log_);
      sink_.request(*request);
    }
    if (stream->damaged())
      log_.report(Severity::Error, "rib-gzip", whole, "the compressed data is " + stream->damage());
    if (!any) log_.report(Severity::Error, "rib-empty", whole, "the file holds no RIB request that could be read");
    return any && !stream->damaged();
  }

 private:
  RiSink& sink_;
  Log& log_;
  rib::Dictionary dictionary_;
};

class MakeSources : public RiSink {
 public:
  void request(const Request& r) override {
    if (!r.name.starts_with("Make")) return;
    const size_t count = r.name == "MakeCubeFaceEnvironment" ? 6 : 1;
    for (size_t i = 0; i < std::min(count, r.args.size()); ++i)
      for (const std::string& name : r.args[i].strings)
        names.insert(std::filesystem::path(name).lexically_normal().string());
  }
  std::set<std::string> names;
};

/// Tells whether a file may hold Make requests other than MakeShadow, whose Displays are maps by their type. A search
/// of the bytes takes a fraction of the time of parsing, and works for binary RIB too, which contains each name once.
bool mayMakeMaps(const std::string& file) {
  constexpr std::string_view kMake = "Make", kShadow = "Shadow";
  const auto stream = rib::ByteStream::open(file);
  std::string seen;
  while (stream && stream->peek() != rib::ByteStream::kEnd) {
    seen.append(stream->begin(), stream->end());
    stream->skipTo(stream->end());
    for (size_t at = seen.find(kMake); at != std::string::npos; at = seen.find(kMake, at + 1))
      if (seen.size() >= at + kMake.size() + kShadow.size() && seen.compare(at + kMake.size(), kShadow.size(), kShadow))
        return true;
    seen.erase(0, seen.size() - std::min(seen.size(), kMake.size() + kShadow.size() - 1));
  }
  return false;
}

}  // namespace

bool readRib(const std::vector<std::string>& files, const RibSettings& settings, Log& log) {
  rib::Reader reader(settings, log);
  bool good = true;
  for (const std::string& file : files) good = reader.readFile(file) && good;
  reader.finish();
  return good;
}

bool readRibText(const std::string& text, const std::string& name, const RibSettings& settings, Log& log) {
  rib::Reader reader(settings, log);
  const bool good = reader.readText(text, name);
  reader.finish();
  return good;
}

bool parseRib(const std::vector<std::string>& files, RiSink& sink, Log& log) {
  PlainParse parse(sink, log);
  bool good = true;
  for (const std::string& file : files)
    good = parse.read(rib::ByteStream::open(file).get(), file == "-" ? "standard input" : file) && good;
  return good;
}

bool parseRibText(const std::string& text, const std::string& name, RiSink& sink, Log& log) {
  return PlainParse(sink, log).read(rib::ByteStream::fromMemory(text).get(), name);
}

std::set<std::string> makeSources(const std::vector<std::string>& files) {
  MakeSources sources;
  Log silent(Log::Verbosity::Silent);  // faults of the scene are reported when it is read
  std::error_code none;
  for (const std::string& file : files)
    if (std::filesystem::is_regular_file(file, none) && mayMakeMaps(file)) parseRib({file}, sources, silent);
  return sources.names;
}

}  // namespace tomales

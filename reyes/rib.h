// Verb: text -> Scene. A streaming reader of RIB (ASCII and binary; gzip is detected) in three steps that meet in the
// Request:
//   lexer   bytes -> tokens
//   parser  tokens -> Request, checked against the request table
//   RiSink  takes Requests
// Bad input is reported with file:line and the reader goes on at the next request.
#pragma once
#include <functional>
#include <iosfwd>
#include <set>

#include "reyes/base/trust.h"
#include "reyes/scene.h"

namespace tomales {

/// One positional argument.
struct RibArg {
  enum class Kind { Number, Integer, String, Numbers, Integers, Strings } kind = Kind::Number;
  std::vector<float> numbers{};
  std::vector<std::string> strings{};
  std::vector<int> integers{};  ///< Exact up to 2^31; other numbers are rounded, and NaN becomes INT_MIN.
  float number() const { return numbers.empty() ? 0.0f : numbers[0]; }
  int integer() const { return integers.empty() ? 0 : integers[0]; }
};

/// A complete request: its positional arguments as the request table orders them, then its parameter list.
struct Request {
  std::string name;
  std::vector<RibArg> args;
  ParamList params;
  SourceLoc where;
  /// Parameters whose value is the output of a Pattern. Such a parameter is a string "handle:output". Each entry has
  /// its name and the type of the value: "reference color c" gives {"c", ValueType::Color}.
  std::vector<std::pair<std::string, ValueType>> references{};
};

inline bool isReference(const Request& request, std::string_view name) {
  return std::any_of(request.references.begin(), request.references.end(),
                     [&](const auto& r) { return r.first == name; });
}

/// Takes the requests of the parser. The scene builder, a recorder and a writer are sinks.
class RiSink {
 public:
  virtual ~RiSink() = default;
  virtual void request(const Request& request) = 0;
};

/// A file that a stream names.
struct FileUse {
  const char* kind;        ///< "archive", "texture", "plugin", or "program", which is a command.
  std::string name, path;  ///< The name as written, and the file's path; empty if it is missing or may not be used.
  SourceLoc where;
};

struct RibSettings {
  /// Called at every WorldEnd with the frozen scene, in stream order.
  std::function<void(Scene&&)> onScene;
  /// Called for MakeTexture, MakeShadow and similar requests, which make maps for later worlds of what earlier ones
  /// have written. If it is empty, they do nothing.
  std::function<void(const Request&)> onMake;
  /// Asked at each FrameBegin of the stream's own files; those in archives are read. If it returns true, the frame is
  /// passed over without being parsed, and onSkipped gets the number of its worlds. Requests of the frame whose effect
  /// would outlive it then have none.
  std::function<bool(int frame)> skipsFrame{};
  std::function<void(int worlds)> onSkipped{};
  /// Called with each request in a frame that forbids skipping frames. Such a request has an effect that outlives the
  /// frame, as Declare has, or is a WorldBegin in an archive, which skipping would not count. Make requests are left
  /// out: onMake gets them.
  std::function<void(const Request&)> onOutliving{};
  /// Called with every file that is read, or would be if it were there.
  std::function<void(const FileUse&)> onFile{};
  std::vector<std::string> archivePath{"."};
  int maxArchiveDepth = 64;
  Trust trust{};  ///< Says which programs (System, Procedural "RunProgram") and plugins ("DynamicLoad") may run.
  double programPatience_s = 60;  ///< The longest that a RunProgram may keep us waiting.
};

/// Reads files as one stream ("-" is standard input). Returns false if any of them could not be opened or held no
/// readable RIB at all; details are in the log.
bool readRib(const std::vector<std::string>& files, const RibSettings& settings, Log& log);
/// Reads the same from memory; `name` stands for the file in messages.
bool readRibText(const std::string& text, const std::string& name, const RibSettings& settings, Log& log);

/// Passes the requests on as they are written and follows no archives, conditions or programs. Returns as readRib.
bool parseRib(const std::vector<std::string>& files, RiSink& sink, Log& log);
bool parseRibText(const std::string& text, const std::string& name, RiSink& sink, Log& log);

/// Returns the pictures that Make requests of the files read, as they name them, but without "./". Standard input,
/// pipes and files that cannot be read give none.
std::set<std::string> makeSources(const std::vector<std::string>& files);

/// Returns the request table, a line for each request. A line has the name of the request, the letters of its arguments
/// (reyes/rib/request_table.h) or -, "parameters" or -, and its treatment: "works", "draws" (works, and the picture
/// needs it), "ignored", or "missing" (ignored, though the picture needs it).
std::string ribRequests();

/// Changes a scene that is hidden already. If a request names the shader that is in use, parameters that it does not
/// give keep their values. Requests other than these are ignored with a warning. Returns as readRib.
///   Surface, Atmosphere, Color, Illuminate, Attribute   change the objects that the last Attribute "identifier" "name"
///                                                       has named; all objects if there was none
///   LightSource                                         changes the light of that handle
///   Exposure, Imager, Quantize                          change the frame
bool editScene(const std::vector<std::string>& files, Scene& scene, Log& log);

struct RibWriterSettings {
  bool binary = false, gzip = false;
  std::function<void(std::string_view)> write;  ///< Called with more of the file.
};
/// Makes a sink that writes requests, which parse as the same again. Its destructor ends the file.
std::unique_ptr<RiSink> makeRibWriter(const RibWriterSettings& settings);

}  // namespace tomales

// Files, archives, programs and memory -> requests -> scene builder. One Reader is one RIB stream, however
// many files it is made of.
#pragma once
#include "reyes/rib/conditions.h"
#include "reyes/rib/dictionary.h"
#include "reyes/rib/scene_builder.h"
#include "reyes/rib/stream.h"

namespace tomales::rib {

/// Declare. Reports what is no declaration.
void declare(const Request& request, Dictionary& dictionary, Log& log);

class Reader {
 public:
  Reader(const RibSettings& settings, Log& log) : settings_(settings), log_(log), builder_(settings, log) {}

  /// False, and reported, if it cannot be opened or holds no request.
  bool readFile(const std::string& path);
  bool readText(const std::string& text, const std::string& name);
  void finish() { builder_.finish(last_); }

 private:
  using Requests = std::vector<Request>;
  using Performer = void (Reader::*)(const Request&);

  /// Between ArchiveBegin and ArchiveEnd.
  struct Recording {
    Request begin;
    Requests requests;
    int depth = 1;  ///< Archives within archives are taken down as they are.
  };
  /// One file, inline archive or program that is being read.
  struct Level {
    std::string key, folder;  ///< Alike for the same archive; where archives are looked for.
    Conditions conditions;
    std::optional<Recording> recording;
  };

  bool readTop(ByteStream& stream, const std::string& name);
  /// The number of good requests.
  size_t read(ByteStream& stream, const std::string& name, const std::string& key, const std::string& folder);
  void enter(const std::string& key, const std::string& folder);
  void leave();
  void handle(const Request& request);
  void perform(const Request& request);
  std::optional<std::string> variable(const std::string& name) const;
  Request substituted(const Request& request) const;
  void report(Severity severity, const char* code, const Request& request, const std::string& what) const;

  // Archives (reader_archives.cpp)
  void record(const Request& request);
  void endRecording();
  void readArchive(const Request& request) { readArchiveNamed(request, request.args[0].strings[0]); }
  void readArchiveNamed(const Request& request, const std::string& name);
  void readArchiveFile(const Request& request, const std::string& name);
  void replay(const Request& request, const std::string& name, const Requests& archive);
  /// False, and reported: it would read itself, or is too deep or too much.
  bool mayEnter(const Request& request, const std::string& key, size_t cost);
  /// Empty: nowhere.
  std::string findArchive(const std::string& name) const;

  // Procedurals and System (reader_programs.cpp)
  void procedural(const Request& request);
  void procedural2(const Request& request);
  void delayedArchive(const Request& request, const std::string& name, const std::vector<float>& bound);
  void runProgram(const Request& request);
  void system(const Request& request);
  bool allowed(const Request& request, const std::string& command) const;
  void perform(const char* blockName, const SourceLoc& where);

  const RibSettings settings_;
  Log& log_;
  Dictionary dictionary_;
  SceneBuilder builder_;
  std::vector<Level> open_;  ///< Outermost first.
  std::map<std::string, std::shared_ptr<const Requests>> inlineArchives_;
  size_t budget_ = 0;  ///< What the outermost archive may still cost: one a request that is replayed.
  char mark_ = 0;      ///< Of variables in strings; 0: there are none.
  SourceLoc last_;
};

}  // namespace tomales::rib

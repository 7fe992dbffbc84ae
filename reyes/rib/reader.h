// Files, archives, programs and memory -> requests -> scene builder. One Reader is one RIB stream, however
// many files it is made of.
#pragma once
#include <atomic>

#include "reyes/rib/conditions.h"
#include "reyes/rib/dictionary.h"
#include "reyes/rib/plugin.h"
#include "reyes/rib/program.h"
#include "reyes/rib/ri_calls.h"
#include "reyes/rib/scene_builder.h"
#include "reyes/rib/stream.h"

namespace tomales::rib {

/// Declare and ColorSamples: what the parser must know. Reports what is none.
void declare(const Request& request, Dictionary& dictionary, Log& log);

class Reader {
 public:
  Reader(const RibSettings& settings, Log& log)
      : settings_(settings),
        log_(log),
        builder_(settings, log),
        programs_(std::make_shared<ProgramPool>()),
        plugins_(std::make_shared<PluginPool>()) {}

  /// False, and reported, if it cannot be opened or holds no request.
  bool readFile(const std::string& path);
  bool readText(const std::string& text, const std::string& name);
  void finish() { builder_.finish(last_); }

 private:
  using Requests = std::vector<Request>;
  using InlineArchives = std::map<std::string, std::shared_ptr<const Requests>>;
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

  /// What a procedural must know of the stream around it, shared by neighbours.
  struct Surroundings {
    RibSettings settings;
    Log& log;
    Dictionary dictionary;
    InlineArchives archives;
    char mark;
    std::vector<std::string> keys;  ///< Of the archives that it stands in.
    std::string folder;
    SceneBuilder::Surroundings builder;
    std::shared_ptr<ProgramPool> programs;
    std::shared_ptr<PluginPool> plugins;
  };
  /// For a procedural: stands where `place` is.
  Reader(const Surroundings& around, const SceneBuilder::Place& place, std::shared_ptr<std::atomic<size_t>> budget);

  bool readTop(ByteStream& stream, const std::string& name);
  /// The number of good requests. `cost`: what each is worth of the budget, beyond which no more are read; 0: all are.
  size_t read(ByteStream& stream, const std::string& name, const std::string& key, const std::string& folder,
              size_t cost = 0);
  void enter(const std::string& key, const std::string& folder);
  void leave();
  void handle(const Request& request);
  void perform(const Request& request);
  std::optional<std::string> variable(const std::string& name) const;
  Request substituted(const Request& request) const;
  Request withRgb(Request request) const;
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
  static std::shared_ptr<std::atomic<size_t>> newBudget();
  bool spend(size_t cost);
  /// Geometry "brickmap": its file is found like a texture.
  void geometry(const Request& request);
  void tellOfFile(const Request& request, const char* kind, const std::string& name, const std::string& path) const {
    if (settings_.onFile) settings_.onFile({kind, name, path, request.where});
  }
  std::vector<std::string> foldersFor(const char* category) const;
  /// Along Option "searchpath" of that category. Empty: nowhere.
  std::string findFile(const std::string& name, const char* category) const;

  // Procedurals and System (reader_programs.cpp)
  void procedural(const Request& request);
  void procedural2(const Request& request);
  /// Now, or as a Procedural of the scene when its bound is needed.
  void later(const Request& request, const std::function<void(Reader&)>& readNow);
  std::shared_ptr<const Surroundings> surroundings();
  void delayedArchive(const Request& request);
  void runProgram(const Request& request);
  /// False, and reported: it is not allowed, or not known.
  bool canRead(const Request& request, const std::string& kind, const std::string& what) const;
  void system(const Request& request);
  bool allowed(const Request& request, const std::string& command) const;
  void perform(const char* blockName, const SourceLoc& where);

  // Plugins (reader_plugins.cpp)
  void dynamicLoad(const Request& request);
  /// Empty, and reported: there is no such file, or none that may be loaded.
  std::string pluginFile(const Request& request, const std::string& name) const;
  void missingPlugin(const Request& request, const std::string& name, const std::string& why) const;
  void callPlugin(const Request& request, const std::string& name, const std::function<void(float)>& subdivide);
  void takeCall(const RiCall& call);

  const RibSettings settings_;
  Log& log_;
  Dictionary dictionary_;
  SceneBuilder builder_;
  std::vector<Level> open_;  ///< Outermost first.
  InlineArchives inlineArchives_;
  /// What the outermost archive or procedural may still cost: one a request that is replayed. Procedurals within share
  /// it.
  std::shared_ptr<std::atomic<size_t>> budget_;
  bool inProcedural_ = false;
  std::shared_ptr<ProgramPool> programs_;
  std::shared_ptr<PluginPool> plugins_;
  std::shared_ptr<const Surroundings> surroundings_;  ///< Null: they have changed.
  char mark_ = 0;                                     ///< Of variables in strings; 0: there are none.
  SourceLoc last_;
};

}  // namespace tomales::rib

// Reads files, archives, programs and memory, and passes requests to the scene builder. One Reader is one RIB stream,
// however many files it is made of.
#pragma once
#include <atomic>

#include "reyes/rib/conditions.h"
#include "reyes/rib/dictionary.h"
#include "reyes/rib/parser.h"
#include "reyes/rib/plugin.h"
#include "reyes/rib/program.h"
#include "reyes/rib/ri_calls.h"
#include "reyes/rib/scene_builder.h"
#include "reyes/rib/stream.h"

namespace tomales::rib {

/// Performs Declare and ColorSamples, which the parser must know. Reports those that it does not understand.
void declare(const Request& request, Dictionary& dictionary, Log& log);

class Reader {
 public:
  Reader(const RibSettings& settings, Log& log)
      : settings_(settings),
        log_(log),
        builder_(settings, log),
        programs_(std::make_shared<ProgramPool>()),
        plugins_(std::make_shared<PluginPool>()) {}

  /// Returns false, and reports it, if the file cannot be opened or holds no request.
  bool readFile(const std::string& path);
  bool readText(const std::string& text, const std::string& name);
  void finish() { builder_.finish(last_); }

 private:
  using Requests = std::vector<Request>;
  using InlineArchives = std::map<std::string, std::shared_ptr<const Requests>>;
  using Performer = void (Reader::*)(const Request&);

  /// The requests between ArchiveBegin and ArchiveEnd.
  struct ArchiveRecording {
    Request begin;
    Requests requests;
    int depth = 1;  ///< Archives within archives are recorded as they are.
  };
  /// One file, inline archive or program that is being read.
  struct Level {
    std::string key, folder;  ///< The key identifies the archive; further archives are looked for in the folder.
    Conditions conditions;
    std::optional<ArchiveRecording> recording;
  };

  /// The state of the stream around a procedural, which its contents depend on. Neighbours share it.
  struct ProceduralContext {
    RibSettings settings;
    Log& log;
    Dictionary dictionary;
    InlineArchives archives;
    char mark;
    std::vector<std::string> keys;  ///< Keys of the archives that it stands in.
    std::string folder;
    SceneBuilder::StreamState builder;
    std::shared_ptr<ProgramPool> programs;
    std::shared_ptr<PluginPool> plugins;
  };
  /// Makes a reader for a procedural at `place`.
  Reader(const ProceduralContext& around, const SceneBuilder::LocalState& place,
         std::shared_ptr<std::atomic<size_t>> budget);

  bool readTop(ByteStream& stream, const std::string& name);
  /// Returns the number of good requests. Each takes `cost` from the budget; reading stops when it is used up. With 0
  /// there is no limit.
  size_t read(ByteStream& stream, const std::string& name, const std::string& key, const std::string& folder,
              size_t cost = 0);
  void enter(const std::string& key, const std::string& folder);
  void leave();
  void handle(const Request& request);
  /// Skips the rest of the frame that the request begins, if the frame is not wanted.
  void skip(const Request& request, Parser& parser);
  void tellOfOutliving(const Request& request) const;
  void perform(const Request& request);
  std::optional<std::string> variable(const std::string& name) const;
  Request substituted(const Request& request) const;
  Request withRgb(Request request) const;
  void report(Severity severity, const char* code, const Request& request, const std::string& what) const;

  // Archives, in reader_archives.cpp.
  void record(const Request& request);
  void endRecording();
  void readArchive(const Request& request) { readArchiveNamed(request, request.args[0].strings[0]); }
  void readArchiveNamed(const Request& request, const std::string& name);
  void readArchiveFile(const Request& request, const std::string& name);
  void replay(const Request& request, const std::string& name, const Requests& archive);
  /// Returns false, and reports it, if the archive would read itself, is nested too deeply, or exceeds the budget.
  bool mayEnter(const Request& request, const std::string& key, size_t cost);
  static std::shared_ptr<std::atomic<size_t>> newBudget();
  bool spend(size_t cost);
  /// Finds the files of Geometry "brickmap", of a Volume and of a Blobby like textures.
  void geometry(const Request& request);
  void tellOfFile(const Request& request, const char* kind, const std::string& name, const std::string& path) const {
    if (settings_.onFile) settings_.onFile({kind, name, path, request.where});
  }
  std::vector<std::string> foldersFor(const char* category) const;
  /// Searches along Option "searchpath" of that category. Returns an empty name if the file is not found.
  std::string findFile(const std::string& name, const char* category) const;

  // Procedurals and System, in reader_programs.cpp.
  void procedural(const Request& request);
  void procedural2(const Request& request);
  /// Reads now, or leaves it to a Procedural of the scene, which is opened when its bound is needed.
  void later(const Request& request, const std::function<void(Reader&)>& readNow);
  std::shared_ptr<const ProceduralContext> proceduralContext();
  void delayedArchive(const Request& request);
  void runProgram(const Request& request);
  /// Returns false, and reports it, if it is not allowed or not known.
  bool canRead(const Request& request, const std::string& kind, const std::string& what) const;
  void system(const Request& request);
  bool allowed(const Request& request, const std::string& command) const;
  /// Performs the request that begins or ends a block: "AttributeBegin".
  void performBlock(const char* name, const SourceLoc& where);

  // Plugins, in reader_plugins.cpp.
  void dynamicLoad(const Request& request);
  /// Returns an empty name, and reports it, if there is no such file or none that may be loaded.
  std::string pluginFile(const Request& request, const std::string& name) const;
  void missingPlugin(const Request& request, const std::string& name, const std::string& why) const;
  void callPlugin(const Request& request, const std::string& name, const std::function<void(float)>& subdivide);
  void takeCall(const RiCall& call);

  const RibSettings settings_;
  Log& log_;
  Dictionary dictionary_;
  SceneBuilder builder_;
  std::vector<Level> open_;  ///< The outermost level is first.
  InlineArchives inlineArchives_;
  /// The cost that is left to the outermost archive or procedural; each replayed request costs one. Procedurals inside
  /// share it.
  std::shared_ptr<std::atomic<size_t>> budget_;
  bool inProcedural_ = false;
  bool inFrame_ = false;
  std::shared_ptr<ProgramPool> programs_;
  std::shared_ptr<PluginPool> plugins_;
  std::shared_ptr<const ProceduralContext> proceduralContext_;  ///< Null if the state has changed since it was made.
  char mark_ = 0;  ///< The character that marks variables in strings; 0 if there is none.
  SourceLoc last_;
};

}  // namespace tomales::rib

// Files, archives and memory -> requests -> scene builder. One Reader is one RIB stream, however many files
// it is made of.
#pragma once
#include "reyes/rib/dictionary.h"
#include "reyes/rib/scene_builder.h"
#include "reyes/rib/stream.h"

namespace tomales::rib {

class Reader {
 public:
  Reader(const RibSettings& settings, Log& log) : settings_(settings), log_(log), builder_(settings, log) {}

  /// False, and reported, if it cannot be opened or holds no request.
  bool readFile(const std::string& path);
  bool readText(const std::string& text, const std::string& name);
  void finish() { builder_.finish(last_); }

 private:
  bool readTop(ByteStream& stream, const std::string& name);
  /// The number of good requests.
  size_t read(ByteStream& stream, const std::string& name);
  void handle(const Request& request);
  void declare(const Request& request);
  void readArchive(const Request& request);
  /// Empty: nowhere.
  std::string findArchive(const std::string& name) const;

  const RibSettings settings_;
  Log& log_;
  Dictionary dictionary_;
  SceneBuilder builder_;
  std::vector<std::string> open_;  ///< The files that are being read, outermost first.
  SourceLoc last_;
  int inlineArchives_ = 0;  ///< Open ArchiveBegins.
};

}  // namespace tomales::rib

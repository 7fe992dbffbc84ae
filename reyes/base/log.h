// What the user is told. Errors in the *scene* go through here with file and line, once per site, and never
// abort; broken promises of ours abort (check.h).
// Threads: every member may be called concurrently.
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace tomales {

/// A place in the user's input. line 0: the file as a whole; no file: the program itself.
struct SourceLoc {
  std::shared_ptr<const std::string> file;
  int line = 0;
  std::string text() const;
};

enum class Severity {
  Info,
  Warning,  ///< Something was ignored or repaired; the picture is what the scene asks for as far as we know.
  Missing,  ///< A texture, shader, archive or object is missing or unusable; a substitute is rendered (exit code 3).
  Error,    ///< The scene could not be read (exit code 2).
  Output,   ///< A picture or file could not be written (exit code 4).
};

struct LogEntry {
  Severity severity;
  std::string code;     ///< Stable short name, e.g. "rib-unknown-request".
  std::string message;  ///< What was wrong, with the object's name, and what was done instead.
  SourceLoc where;
  int count = 1;  ///< How often this site reported this code.
};

class Log {
 public:
  enum class Verbosity { Quiet, Normal, Verbose };
  static constexpr int kMostLinesOfCode = 100;
  explicit Log(Verbosity verbosity = Verbosity::Normal) : verbosity_(verbosity) {}

  /// Prints to stderr the first time that (code, where) reports, and counts after that. Of one code the first
  /// kMostLinesOfCode sites are printed.
  void report(Severity severity, std::string_view code, const SourceLoc& where, const std::string& message);

  std::vector<LogEntry> entries() const;  ///< In order of first report.
  Severity worst() const;                 ///< Info if nothing was reported.
  int count(std::string_view code) const;

 private:
  using Key = std::tuple<std::string, std::string, int>;
  const Verbosity verbosity_;
  mutable std::mutex mutex_;
  std::map<Key, size_t> index_;
  std::map<std::string, int, std::less<>> lines_;  ///< Printed or withheld, of each code.
  std::vector<LogEntry> entries_;
};

}  // namespace tomales

// What the user is told. Errors in the *scene* go through here with file and line, once for each cause, and never
// abort; broken promises of ours abort (check.h).
// Threads: every member may be called concurrently.
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
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
  Note,     ///< Worth a word, and nothing of the picture depends on it.
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
  int count = 1;                    ///< How often it was reported.
  std::vector<SourceLoc> places{};  ///< The first of them, `where` among them; no more than Log::kMostPlaces.
};

class Log {
 public:
  enum class Verbosity { Quiet, Normal, Verbose };
  static constexpr int kMostLinesOfCode = 100;
  static constexpr size_t kMostPlaces = 4;
  static constexpr size_t kMostRepeated = 10;  ///< Messages whose places the destructor prints.
  explicit Log(Verbosity verbosity = Verbosity::Normal) : verbosity_(verbosity) {}
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;
  /// Prints how often and where messages were reported that came from several places.
  ~Log();

  /// Prints to stderr the first time that (code, subject) reports, and counts after that. The subject is what the
  /// report is about, such as a shader's name; empty: the message, together with the file where that has no line.
  /// It is to be given where one cause has messages that differ. Of one code kMostLinesOfCode messages are printed.
  void report(Severity severity, std::string_view code, const SourceLoc& where, const std::string& message,
              std::string_view subject = {});

  std::vector<LogEntry> entries() const;  ///< In order of first report.
  Severity worst() const;                 ///< Info if nothing was reported.
  int count(std::string_view code) const;

 private:
  using Key = std::pair<std::string, std::string>;  // code, subject
  bool isWanted(Severity severity) const;
  void printRepeated() const;
  const Verbosity verbosity_;
  mutable std::mutex mutex_;
  std::map<Key, size_t> index_;
  std::map<std::string, int, std::less<>> lines_;  ///< Printed or withheld, of each code.
  std::vector<LogEntry> entries_;
};

}  // namespace tomales

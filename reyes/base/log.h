// Messages to the user. Errors in the *scene* go through here with file and line, once for each cause, and never abort;
// broken invariants of our own code abort (check.h). Threads: every member may be called concurrently.
#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tomales {

class AppendedFile;

/// A place in the user's input. Line 0 is the file as a whole; no file means the program itself.
struct SourceLoc {
  std::shared_ptr<const std::string> file;
  int line = 0;
  std::string text() const;
  /// Returns the folder of the file as it was named; empty if there is none, or if the file lies in the working folder.
  std::filesystem::path folder() const { return file ? std::filesystem::path(*file).parent_path() : ""; }
};

enum class Severity {
  Info,
  Note,     ///< Worth knowing, but the picture does not depend on it.
  Warning,  ///< Something was ignored or repaired; the picture is what the scene asks for as far as we know.
  Missing,  ///< A texture, shader, archive or object is missing or unusable; a substitute is rendered (exit code 3).
  Error,    ///< The scene could not be read (exit code 2).
  Output,   ///< A picture or file could not be written (exit code 4).
};

struct LogEntry {
  Severity severity;
  std::string code;     ///< Stable short name, e.g. "rib-unknown-request".
  std::string message;  ///< Says what was wrong, with the object's name, and what was done instead.
  SourceLoc where;
  int count = 1;                    ///< Number of times that the message was reported.
  std::vector<SourceLoc> places{};  ///< Its first places, `where` among them; at most Log::kMostPlaces.
};

class Log {
 public:
  enum class Verbosity {
    Silent,  ///< Prints nothing; entries() has the messages.
    Quiet,
    Normal,
    Verbose
  };
  static constexpr int kMostLinesOfCode = 100;
  static constexpr size_t kMostPlaces = 4;
  static constexpr size_t kMostRepeated = 10;  ///< Messages whose places the destructor prints.
  explicit Log(Verbosity verbosity = Verbosity::Normal);
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;
  /// Prints, for messages that came from several places, how often and where they were reported.
  ~Log();

  /// Appends all later messages to a file too, whatever the verbosity, each with the time (UTC) before it, and makes
  /// the file if it is missing. Several programs may write to one. Returns false, and sets `error`, if it cannot be
  /// opened.
  bool alsoTo(const std::string& file, std::string& error);

  /// Prints to stderr the first time that (code, subject) reports, and counts after that. The subject is what the
  /// report is about, such as a shader's name: give it where one cause has messages that differ. If empty, it is the
  /// message, together with the file if there is no line. At most kMostLinesOfCode messages of a code are printed.
  void report(Severity severity, std::string_view code, const SourceLoc& where, const std::string& message,
              std::string_view subject = {});

  std::vector<LogEntry> entries() const;  ///< Sorted by the time of the first report.
  Severity worst() const;                 ///< Info if nothing was reported.
  int count(std::string_view code) const;

 private:
  using Key = std::pair<std::string, std::string>;  // code, subject
  bool isWanted(Severity severity) const;
  void printRepeated() const;
  void append(const std::string& line);
  const Verbosity verbosity_;
  mutable std::mutex mutex_;
  std::map<Key, size_t> index_;
  std::map<std::string, int, std::less<>> lines_;  ///< Number of lines printed or withheld, by code.
  std::vector<LogEntry> entries_;
  std::unique_ptr<AppendedFile> file_;  ///< Null unless alsoTo() has opened it.
};

}  // namespace tomales

#include "reyes/app/commands/catrib.h"

#include <signal.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "reyes/base/unfinished_file.h"
#include "reyes/rib.h"

namespace tomales {
namespace {

/// Returns false if not everything could be written, and `error` says why.
bool copyTo(std::FILE* out, const CatribSettings& settings, std::string& error, Log& log) {
  const auto write = [&](std::string_view text) {
    if (error.empty() && std::fwrite(text.data(), 1, text.size(), out) != text.size()) error = std::strerror(errno);
  };
  parseRib(settings.files, *makeRibWriter({settings.binary, settings.gzip, write}), log);
  if (std::fflush(out) != 0 && error.empty()) error = std::strerror(errno);
  return error.empty();
}

bool toStandardOutput(const CatribSettings& settings, std::string& error, Log& log) {
  ::signal(SIGPIPE, SIG_DFL);  // this ends the program quietly when nobody reads the rest
  const bool written = copyTo(stdout, settings, error, log);
  std::clearerr(stdout);  // the failure is reported with its reason
  return written;
}

/// The output may be one of the files that are read.
bool toFile(const CatribSettings& settings, std::string& error, Log& log) {
  const auto file = UnfinishedFile::create(settings.output, UnfinishedKind::Stream, error);
  if (!file || !copyTo(file->stream(), settings, error, log)) return false;
  if (log.worst() >= Severity::Missing && isAmong(settings.output, settings.files)) {
    error = "it is the scene itself, of which not everything could be read: it stays as it was";
    return false;
  }
  const bool isUnread = log.worst() >= Severity::Error;
  if (isUnread && std::filesystem::is_regular_file(settings.output)) return true;  // the log says why; that file stays
  return file->finish(error);
}

}  // namespace

int catribCommand(const CatribSettings& settings) {
  Log log;
  std::string error;
  if (!(settings.output.empty() ? toStandardOutput : toFile)(settings, error, log))
    log.report(Severity::Output, "output-write",
               {std::make_shared<std::string>(settings.output.empty() ? "standard output" : settings.output), 0},
               "cannot be written: " + error);
  return exitCodeOf(log);
}

}  // namespace tomales

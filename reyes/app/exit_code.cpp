#include "reyes/app/exit_code.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <new>
#include <optional>

#include "reyes/base/chunk_file.h"

namespace tomales {
namespace {

struct Ending {
  ExitCode code;
  std::optional<Severity> least;  ///< The least severity that leads here; none if no report does.
  const char* meaning;
};
constexpr Ending kEndings[] = {{kDone, Severity::Info, "done"},
                               {kUsage, std::nullopt, "wrong usage"},
                               {kUnreadable, Severity::Error, "the scene could not be read"},
                               {kIncomplete, Severity::Missing,
                                "the frame is complete but something was missing and a loud substitute was rendered"},
                               {kUnwritable, Severity::Output, "output could not be written"}};

constexpr const char* kOutOfMemory = "out of memory";

/// It allocates nothing.
[[noreturn]] void endWithMessage() {
  const char* message = kOutOfMemory;  // used if there was no memory for an exception either
  const std::exception_ptr thrown = std::current_exception();
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
  } catch (const std::exception& e) {
    message = e.what();  // the text lives as long as `thrown`
  } catch (...) {
    message = "something unknown was thrown";
  }
  for (const char* part : {"tomales: output error: ", message, "\n"}) std::fputs(part, stderr);
  std::_Exit(kUnwritable);
}

}  // namespace

void endWithMessages() { std::set_terminate(endWithMessage); }

ExitCode exitCodeOf(Severity severity) {
  const Ending* out = std::begin(kEndings);
  for (const Ending& e : kEndings)
    if (e.least && *e.least <= severity && *e.least >= *out->least) out = &e;
  return out->code;
}

ExitCode exitCodeOf(const Log& log, bool strict) {
  const Severity worst = log.worst();
  return exitCodeOf(strict && worst == Severity::Warning ? Severity::Missing : worst);
}

std::string exitCodeHelp() {
  std::string out = "Exit codes:";
  for (const Ending& e : kEndings) out += fmt::format("\n  {}  {}", static_cast<int>(e.code), e.meaning);
  return out + "\n  129, 130, 143  interrupted by SIGHUP, SIGINT, SIGTERM; finished buckets are written";
}

Severity severityOf(const std::exception& e) {
  const bool unread = dynamic_cast<const FileError*>(&e) && !dynamic_cast<const WriteError*>(&e);
  return unread ? Severity::Error : Severity::Output;
}

Severity severityOfLoss(const std::exception& e) {
  return severityOf(e) == Severity::Error ? Severity::Missing : severityOf(e);
}

std::string messageOf(const std::exception& e) {
  return dynamic_cast<const std::bad_alloc*>(&e) ? kOutOfMemory : e.what();
}

}  // namespace tomales

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
  std::optional<Severity> least;  ///< Of what is reported; none: no report leads here.
  const char* meaning;
};
constexpr Ending kEndings[] = {{kDone, Severity::Info, "done"},
                               {kUsage, std::nullopt, "wrong usage"},
                               {kUnreadable, Severity::Error, "the scene could not be read"},
                               {kIncomplete, Severity::Missing, "the frame is complete but something was missing and a loud substitute was rendered"},
                               {kUnwritable, Severity::Output, "output could not be written"}};

[[noreturn]] void endWithMessage() {
  try {
    if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::exception& e) {
    std::fputs(("tomales: output error: " + messageOf(e) + "\n").c_str(), stderr);
    std::_Exit(exitCodeOf(severityOf(e)));
  } catch (...) {
  }
  std::abort();
}

}  // namespace

void endWithMessages() { std::set_terminate(endWithMessage); }

ExitCode exitCodeOf(Severity severity) {
  const Ending* out = std::begin(kEndings);
  for (const Ending& e : kEndings)
    if (e.least && *e.least <= severity && *e.least >= *out->least) out = &e;
  return out->code;
}

ExitCode exitCodeOf(const Log& log) { return exitCodeOf(log.worst()); }

std::string exitCodeHelp() {
  std::string out = "Exit codes:";
  for (const Ending& e : kEndings) out += fmt::format("\n  {}  {}", static_cast<int>(e.code), e.meaning);
  return out + "\n  130, 143  interrupted; finished buckets are written";
}

Severity severityOf(const std::exception& e) {
  const bool unread = dynamic_cast<const FileError*>(&e) && !dynamic_cast<const WriteError*>(&e);
  return unread ? Severity::Error : Severity::Output;
}

Severity severityOfLoss(const std::exception& e) { return severityOf(e) == Severity::Error ? Severity::Missing : severityOf(e); }

std::string messageOf(const std::exception& e) { return dynamic_cast<const std::bad_alloc*>(&e) ? "out of memory" : e.what(); }

}  // namespace tomales

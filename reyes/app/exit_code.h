// The end of a command: the severity of what went wrong, and the exit code that this leads to. One table has all of
// them (exit_code.cpp).
#pragma once
#include <exception>
#include <string>

#include "reyes/base/log.h"

namespace tomales {

enum ExitCode { kDone = 0, kUsage = 1, kUnreadable = 2, kIncomplete = 3, kUnwritable = 4 };

/// Tells whether a program that returned this code has finished its picture. The picture may hold substitutes, which
/// the log names.
constexpr bool succeeded(int code) { return code == kDone || code == kIncomplete; }
ExitCode exitCodeOf(Severity severity);
/// Returns the code for the worst severity that was reported. With `strict` a warning counts as something missing.
ExitCode exitCodeOf(const Log& log, bool strict = false);
/// Returns all exit codes and their meanings, for --help.
std::string exitCodeHelp();

/// Returns the severity of an exception that ends a command: Error if a file cannot be read; else Output, as where
/// something cannot be written, or where memory or threads do not suffice to make it.
Severity severityOf(const std::exception& e);
/// Returns the severity where a substitute is rendered instead: Missing takes the place of Error.
Severity severityOfLoss(const std::exception& e);
/// Returns the message of an exception for the user.
std::string messageOf(const std::exception& e);

/// From now on an exception that a thread lets out ends the program with its message and the exit code for it. (oneTBB
/// starts threads from threads of its own, and throws there if the system has none left.)
void endWithMessages();

/// Runs `work` and reports what it throws.
template <class Work>
void guarded(Log& log, const Work& work) {
  try {
    work();
  } catch (const std::exception& e) {
    log.report(severityOf(e), "file", {}, messageOf(e));
  }
}

}  // namespace tomales

#include "reyes/app/commands/command.h"

#include <csignal>
#include <cstdio>

#include "reyes/app/build_info.h"
#include "reyes/app/commands/help.h"
#include "reyes/app/commands/usage.h"
#include "reyes/app/exit_code.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/base/crash_note.h"
#include "reyes/base/deep_stack.h"
#include "reyes/base/nursery.h"
#include "reyes/base/process.h"

namespace tomales {
namespace {

/// Tells whether the text names a command. If not, the arguments are those of render.
bool namesCommand(const CLI::App& app, const std::string& text) {
  for (const char* name : {"-h", "--help", "--help-all", "--version"})
    if (text == name) return true;
  return !app.get_subcommands([&](const CLI::App* c) { return c->get_name() == text; }).empty();
}

/// The library says of an option that is given twice: "-t: At Most 1 required but received 2".
std::string failureOf(const CLI::App* app, const CLI::Error& e) {
  std::string out = CLI::FailureMessage::simple(app, e);
  const size_t at = out.find(": At Most 1 required but received ");
  if (at != std::string::npos) out.replace(at, out.find('\n', at) - at, " is given more than once");
  return out;
}

int parseAndRun(int argc, char** argv) {
  CLI::App app("A Reyes renderer with global illumination", "tomales");
  app.set_version_flag("--version", describeBuild());
  app.footer(exitCodeHelp());
  app.failure_message(failureOf);
  app.require_subcommand(1);
  setHelp(app);
  Invocation in;
  int code = kDone;
  addFrameCommands(app, in, code);
  addFileCommands(app, in, code);
  addAtlasCommands(app, in, code);
  refuseOptionsAsValues(app);
  finishHelp(app);

  std::vector<std::string> arguments(argv + 1, argv + argc);
  in.render.report.commandLine = "tomales";
  for (const std::string& a : arguments) in.render.report.commandLine += " " + a;
  if (!arguments.empty() && !namesCommand(app, arguments.front())) arguments.insert(arguments.begin(), "render");
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes a vector from its back
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kDone : kUsage;
  }
  return code;
}

int runGuarded(int argc, char** argv) {
  Log log;
  int code = kDone;
  guarded(log, [&] { code = parseAndRun(argc, argv); });
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    log.report(Severity::Output, "output-write", {std::make_shared<std::string>("standard output"), 0},
               "cannot be written");
  return log.worst() > Severity::Info && !interruptExitCode() ? exitCodeOf(log) : code;
}

}  // namespace

int runTexts(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  return run(static_cast<int>(arguments.size()), argv.data());
}

int run(int argc, char** argv) {
  openStandardFiles();
  keepFreedMemory();
  if (argc > 1 && std::string(argv[1]) == "batch") openNursery(runTexts);  // this comes before there are threads
  endWithMessages();
  reportCrashes();
  watchSignals();  // this comes before other threads start, which must not get the signals
  int code = kDone;
  runOnDeepStack([&] { code = runGuarded(argc, argv); });
  return code;
}

}  // namespace tomales

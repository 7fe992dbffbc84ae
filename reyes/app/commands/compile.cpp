#include "reyes/app/commands/compile.h"

#include <fmt/format.h>

#include <cstdio>

#include "reyes/app/exit_code.h"
#include "reyes/app/settings.h"
#include "reyes/base/input_file.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

void compile(const std::string& path, const RslSettings& settings, const CompileCommand& command, Log& log) {
  if (const std::string problem = inputProblem(path); !problem.empty())
    return log.report(Severity::Error, "compile", {}, fmt::format("{} cannot be read: {}", path, problem));
  if (!command.dump.empty()) std::fputs(RslFile::dump(path, settings, command.dump).c_str(), stdout);
  const std::shared_ptr<const RslFile> file = RslFile::compile(path, settings);
  const bool tells = file->errors() > 0 || file->missing() > 0 || !command.quiet;
  if (tells) std::fputs(file->messages().c_str(), stderr);
  if (file->errors() > 0)
    log.report(Severity::Error, "compile", {},
               fmt::format("{}: {} error{}", path, file->errors(), file->errors() == 1 ? "" : "s"));
  else if (file->missing() > 0)
    log.report(
        Severity::Missing, "compile", {},
        fmt::format("{}: {} functions that it calls were not found; it runs with substitutes", path, file->missing()));
}

}  // namespace

RslSettings rslSettings(const std::vector<std::string>& folders, const std::vector<std::string>& definitions) {
  RslSettings out{.includeFolders = folders};
  for (const std::string& d : definitions) {
    const size_t at = d.find('=');
    out.definitions.push_back({d.substr(0, at), at == std::string::npos ? "1" : d.substr(at + 1)});
  }
  return out;
}

int compileCommand(const CompileCommand& command) {
  Log log;
  const ShaderRegistry registry(log, pluginTrust(Trust{.shaderFolders = command.shaderFolders}));
  const std::unique_ptr<const RslFunctions> functions = registry.functions("");
  RslSettings settings = rslSettings(command.folders, command.definitions);
  settings.functions = functions.get();
  for (const std::string& path : command.files) compile(path, settings, command, log);
  return exitCodeOf(log);
}

}  // namespace tomales

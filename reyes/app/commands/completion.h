// Completion of the command line in a shell, made from the same tables as --help.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace tomales {

/// Returns a script for bash that completes commands, options, and the values of options that take one of a few words.
/// Zsh reads it too, after `autoload -U bashcompinit && bashcompinit`.
std::string completionScript(const CLI::App& program);

}  // namespace tomales

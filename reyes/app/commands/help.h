// The layout of --help: options in groups, everyday ones on one screen, an example for each command.
#pragma once
#include <CLI/CLI.hpp>

namespace tomales {

/// Gives --help and --help-all this layout, also for commands that are added afterwards.
void setHelp(CLI::App& program);
/// Sorts the options of all commands into their groups, and adds the examples. Call it after all commands are added.
void finishHelp(CLI::App& program);

}  // namespace tomales

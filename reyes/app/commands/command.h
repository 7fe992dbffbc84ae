// The command line: reads arguments, runs the command, returns the exit code.
#pragma once

namespace tomales {
int run(int argc, char** argv);
}

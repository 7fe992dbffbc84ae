// SIGINT and SIGTERM as a flag. The first asks for an orderly end; a second ends the process.
#pragma once
#include <atomic>

namespace tomales {

/// Installs the handlers; idempotent.
void catchInterrupts();
/// Set by the first signal; what the stages watch.
const std::atomic<bool>& interrupted();
/// 130 for SIGINT, 143 for SIGTERM, 0 if neither came.
int interruptExitCode();

}  // namespace tomales

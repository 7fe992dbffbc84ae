// The end of the program by SIGINT, SIGTERM, or SIGHUP (unless that is ignored, as nohup has it). Work that can keep
// finished parts asks for an orderly end: the first signal then asks for a stop, which its stages watch. A second
// signal, or the first one during other work such as reading RIB, ends the process at once, without leaving unfinished
// files or programs behind (reyes/base/abrupt_end.h). The same happens, with a message, if a shader does not return
// within 10 s.
#pragma once
namespace tomales {

/// Opens standard files that are closed, in such a way that their use still fails. Otherwise the next file that the
/// program opens would take their place and get its messages. Call it once, before anything else is opened.
void openStandardFiles();
/// Call it once, before other threads start: they must not get the signals. A pipe that nobody reads any more (SIGPIPE)
/// and a file that is too large (SIGXFSZ, ulimit -f) are then errors of write().
void watchSignals();
/// While one exists, the first signal asks for a stop (reyes/base/stop.h). They do not nest.
class OrderlyEnd {
 public:
  OrderlyEnd();
  ~OrderlyEnd();
  OrderlyEnd(const OrderlyEnd&) = delete;
};
/// Returns 129 for SIGHUP, 130 for SIGINT, 143 for SIGTERM, 0 if none came.
int interruptExitCode();

}  // namespace tomales

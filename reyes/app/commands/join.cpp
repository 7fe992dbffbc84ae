#include "reyes/app/commands/join.h"

#include "reyes/app/exit_code.h"
#include "reyes/base/unfinished_file.h"
#include "reyes/image.h"
#include "reyes/image_files.h"

namespace tomales {

int joinCommand(const JoinCommand& command) {
  Log log;
  if (isAmong(command.output, command.tiles)) {
    log.report(Severity::Output, "output-input", {},
               "\"" + command.output + "\" is one of the tiles, and is not written over");
    return exitCodeOf(log);
  }
  try {
    joinPictures(command.tiles, command.output, command.crop);
  } catch (const std::exception& e) {
    log.report(severityOf(e), "join", {}, messageOf(e));
  }
  return exitCodeOf(log);
}

}  // namespace tomales

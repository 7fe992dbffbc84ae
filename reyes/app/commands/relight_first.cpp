#include "reyes/app/commands/relight_first.h"

#include <filesystem>

#include "reyes/app/commands/render.h"

namespace tomales {

int relightFirst(RelightCommand command) {
  if (std::filesystem::path(command.render.input.files.front()).extension() != ".dfb") command.hide = hideCommand;
  return relightCommand(command);
}

}  // namespace tomales

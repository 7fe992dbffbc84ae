// `tomales relight`: lights of a shot are changed in a browser.
#pragma once
#include "reyes/app/settings.h"

namespace tomales {

struct RelightCommand {
  RenderSettings render;     ///< The shot, its .icf, and edits that come before the page's.
  int port = 0;              ///< 0: any that is free.
  std::string folder = ".";  ///< Edits are saved and loaded here.
  bool opens = true;         ///< A browser is opened.
  /// Hides a scene to PictureSettings::output, and returns an exit code; empty: the shot is hidden already.
  std::function<int(const RenderSettings&)> hide{};
};

/// Serves the page until it is ended. The page shows the work that has to be done first. Returns the exit code.
int relightCommand(const RelightCommand& command);

}  // namespace tomales

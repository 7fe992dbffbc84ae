// Folders of files that a user keeps for all scenes.
#pragma once
#include <span>
#include <string>

namespace tomales {

/// Returns the path of `name` in the user's folder of configuration, which is XDG_CONFIG_HOME/tomales or else
/// ~/.config/tomales. Empty if neither variable is set.
std::string userFolder(const std::string& name);

/// A kind of files that a user may keep for all scenes: an environment variable that names folders, and a folder of the
/// configuration.
struct StandardPlace {
  const char *kind, *variable, *folder;
};
std::span<const StandardPlace> standardPlaces();
/// Returns the folders where files of a kind are looked for after the folders that the scene names; empty if there are
/// none, or no such kind.
std::string standardPath(const std::string& kind);
/// Puts folders before those of standardPath(). Threads: no other may run. Pre: the kind is one of standardPlaces().
void addToStandardPath(const std::string& kind, const std::string& folders);

}  // namespace tomales

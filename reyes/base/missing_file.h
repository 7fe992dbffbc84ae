// Hints for a user who named a file that was not found. The folders around are searched, within bounds.
#pragma once
#include <string>
#include <vector>

namespace tomales {

/// Tells what exists under the name or a similar one, as the end of a message: "; \"../maps/Wood.tif\" is there, in a
/// folder that is not searched", "; did you mean \"wood.tif\"?", or nothing. `folders` are those that were searched for
/// `name`. A file matches if its name is that of `name` without regard to capitals, or if it differs in the ending
/// alone and has one of `endings` (".tif").
std::string hintOfMissing(const std::string& name, const std::vector<std::string>& endings,
                          const std::vector<std::string>& folders);

/// Lists folders in a message: "., shaders and /home/me/scenes".
std::string listOfFolders(const std::vector<std::string>& folders);

}  // namespace tomales

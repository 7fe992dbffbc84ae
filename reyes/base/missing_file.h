// What helps whoever named a file that was not found. The folders around are searched, within bounds.
#pragma once
#include <string>
#include <vector>

namespace tomales {

/// What lies there under the name or a similar one, as the end of a message: "; \"../maps/Wood.tif\" is there, in a
/// folder that is not searched", "; did you mean \"wood.tif\"?", or nothing. `folders` are those that were searched for
/// `name`. A file is of that name if the name of its file is, in any capitals, or if all but the ending is and its own
/// ending is one of `endings` (".tif").
std::string hintOfMissing(const std::string& name, const std::vector<std::string>& endings,
                          const std::vector<std::string>& folders);

/// "., shaders and /home/me/scenes".
std::string listOfFolders(const std::vector<std::string>& folders);

}  // namespace tomales

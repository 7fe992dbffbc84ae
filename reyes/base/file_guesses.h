// Guesses which file a name means if no file has it, because the scene was written on another machine or in another
// folder.
#pragma once
#include <string>
#include <vector>

namespace tomales {

/// Returns the last part of a name that has folders of Unix or Windows before it. Empty if it has none.
std::string lastPartOf(const std::string& name);

/// Returns the names that a missing file with folders in its name may have here, the likeliest first. Scenes name files
/// where they were on another machine, or relative to a folder above. For "/home/ann/bowl/maps/a.tx" these are
/// "ann/bowl/maps/a.tx", "bowl/maps/a.tx" and "maps/a.tx", and at last "a.tx". A folder among `folders`, or above one
/// of them, also matches by its own name: "maps/a.tx" is looked for in a folder called "bowl". A relative name such as
/// "maps/a.tx" may lie in any of these folders. Returns nothing for a name that is too long for a file.
std::vector<std::string> pathSuffixes(const std::string& name, const std::vector<std::string>& folders);

/// Returns the files that a name may mean, best first:
///   1 that of findFile() (reyes/base/search_path.h)
///   2 those of its name but with one of `endings`: the picture that a texture was made of lies beside it
///   3 the same two for each of pathSuffixes() the name
std::vector<std::string> candidateFiles(const std::string& name, const std::string& searchPath,
                                        const std::vector<std::string>& endings = {});

}  // namespace tomales

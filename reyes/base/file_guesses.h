// Which file a name may mean that is not there, because the scene was written on another machine or in another folder.
#pragma once
#include <string>
#include <vector>

namespace tomales {

/// Returns the last part of a name that has folders of Unix or Windows before it. Empty if it has none.
std::string lastPartOf(const std::string& name);

/// Returns what a name may mean that has folders before it and is not there, the likeliest first. Scenes name files
/// where they lay on another machine, or as seen from a folder above. For "/home/ann/bowl/maps/a.tx" these are
/// "ann/bowl/maps/a.tx", "bowl/maps/a.tx" and "maps/a.tx", and at last "a.tx". Each is also looked for in those of
/// `folders`, and of the folders above them, that have the name of the part before: "maps/a.tx" in a folder "bowl". The
/// relative name "maps/a.tx" may lie in any of these folders. Empty for a name that is too long for a file.
std::vector<std::string> pathSuffixes(const std::string& name, const std::vector<std::string>& folders);

/// Returns the files that a name may mean, best first:
///   1 that of findFile() (reyes/base/search_path.h)
///   2 those of its name but with one of `endings`: the picture that a texture was made of lies beside it
///   3 the same two for each of pathSuffixes() the name
std::vector<std::string> candidateFiles(const std::string& name, const std::string& searchPath,
                                        const std::vector<std::string>& endings = {});

}  // namespace tomales

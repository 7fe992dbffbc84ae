// Lists of folders, in the form of Option "searchpath" after expansion.
#pragma once
#include <map>
#include <span>
#include <string>
#include <vector>

namespace tomales {

/// Returns the folders between the colons; empty names are left out.
std::vector<std::string> foldersOf(const std::string& searchPath);

/// Adds after each relative folder the one of that name in `base`. The folder "." stays the working folder alone.
std::string alsoWithin(const std::string& searchPath, const std::string& base);

/// Returns the search path of `kind`, empty if there is none.
std::string pathOf(const std::map<std::string, std::string>& searchPaths, const std::string& kind);

/// Returns `file` in each folder that has it, or nothing if its name leads out of them, as "../a.so" and "/a.so" do.
std::vector<std::string> filesWithin(const std::string& searchPath, const std::string& file);

/// Returns `name` in the first folder that has such a file, else `name` itself if it is a file, else nothing. Absolute
/// names are not searched for.
std::string findFile(const std::string& name, const std::string& searchPath);

/// Returns the last part of a name that has folders of Unix or Windows before it. Empty if it has none.
std::string lastPartOf(const std::string& name);

/// Returns what a name may mean that has folders before it and is not there, the likeliest first. Scenes name files
/// where they lay on another machine, or as seen from a folder above. For "/home/ann/bowl/maps/a.tx" these are
/// "ann/bowl/maps/a.tx", "bowl/maps/a.tx" and "maps/a.tx", and at last "a.tx". Each is also looked for in those of
/// `folders`, and of the folders above them, that have the name of the part before: "maps/a.tx" in a folder "bowl". The
/// relative name "maps/a.tx" may lie in any of these folders. Empty for a name that is too long for a file.
std::vector<std::string> pathSuffixes(const std::string& name, const std::vector<std::string>& folders);

/// Returns the files that a name may mean, best first:
///   1 that of findFile()
///   2 those of its name but with one of `endings`: the picture that a texture was made of lies beside it
///   3 the same two for each of pathSuffixes() the name
std::vector<std::string> candidateFiles(const std::string& name, const std::string& searchPath,
                                        const std::vector<std::string>& endings = {});

/// Returns the path of `name` in the user's folder of configuration, which is XDG_CONFIG_HOME/tomales or else
/// ~/.config/tomales. Empty if neither variable is set.
std::string userFolder(const std::string& name);

/// A kind of files that a user may keep for all scenes: folders in an environment variable, and one of the
/// configuration.
struct StandardPlace {
  const char *kind, *variable, *folder;
};
std::span<const StandardPlace> standardPlaces();
/// Returns the folders where files of a kind are looked for after the folders that the scene names. Empty: nowhere, or
/// there is no such kind.
std::string standardPath(const std::string& kind);
/// Puts folders before those that standardPath() has. Threads: none may run. Pre: the kind is one of standardPlaces().
void addToStandardPath(const std::string& kind, const std::string& folders);

}  // namespace tomales

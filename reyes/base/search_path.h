// Lists of folders, in the form of Option "searchpath" after expansion.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace tomales {

/// Returns the folders between the colons; empty names are left out.
std::vector<std::string> foldersOf(const std::string& searchPath);

/// Adds after each relative folder the folder of that name in `base`. To "." nothing is added.
std::string alsoWithin(const std::string& searchPath, const std::string& base);

/// Returns the search path of `kind`, empty if there is none.
std::string pathOf(const std::map<std::string, std::string>& searchPaths, const std::string& kind);

/// Returns `file` in each folder that has it, or nothing if its name leads out of them, as "../a.so" and "/a.so" do.
std::vector<std::string> filesWithin(const std::string& searchPath, const std::string& file);

/// Returns `name` in the first folder that has such a file, else `name` itself if it is a file, else nothing. Absolute
/// names are not searched for.
std::string findFile(const std::string& name, const std::string& searchPath);

}  // namespace tomales

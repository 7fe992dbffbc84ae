// Lists of folders, as Option "searchpath" has them after expansion.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace tomales {

/// Between the colons; what is empty is left out.
std::vector<std::string> foldersOf(const std::string& searchPath);

/// That of `kind`; empty: there is none.
std::string pathOf(const std::map<std::string, std::string>& searchPaths, const std::string& kind);

/// `file` in each of the folders that has it. None if its name leads out of them, as "../a.so" and "/a.so" do.
std::vector<std::string> filesWithin(const std::string& searchPath, const std::string& file);

/// `name` in the first folder that has such a file, else `name` itself if it is one, else nothing. Absolute names are
/// not searched for.
std::string findFile(const std::string& name, const std::string& searchPath);

}  // namespace tomales

#include "reyes/base/search_path.h"

#include <filesystem>
#include <sstream>

namespace tomales {

std::vector<std::string> foldersOf(const std::string& searchPath) {
  std::vector<std::string> out;
  std::istringstream list(searchPath);
  for (std::string folder; std::getline(list, folder, ':');)
    if (!folder.empty()) out.push_back(folder);
  return out;
}

std::string pathOf(const std::map<std::string, std::string>& searchPaths, const std::string& kind) {
  const auto it = searchPaths.find(kind);
  return it == searchPaths.end() ? std::string() : it->second;
}

std::string findFile(const std::string& name, const std::string& searchPath) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (fs::path(name).is_relative())
    for (const fs::path folder : foldersOf(searchPath))
      if (const fs::path file = folder / name; fs::is_regular_file(file, none)) return file.string();
  return fs::is_regular_file(name, none) ? name : "";
}

}  // namespace tomales

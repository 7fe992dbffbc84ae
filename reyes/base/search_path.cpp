#include "reyes/base/search_path.h"

#include <algorithm>
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

std::string alsoWithin(const std::string& searchPath, const std::string& base) {
  std::string out;
  const auto add = [&](const std::string& folder) { out += (out.empty() ? "" : ":") + folder; };
  for (const std::string& folder : foldersOf(searchPath)) {
    add(folder);
    if (std::filesystem::path(folder).is_relative() && folder != "." && !base.empty())
      add((std::filesystem::path(base) / folder).string());
  }
  return out;
}

std::string pathOf(const std::map<std::string, std::string>& searchPaths, const std::string& kind) {
  const auto it = searchPaths.find(kind);
  return it == searchPaths.end() ? std::string() : it->second;
}

std::vector<std::string> filesWithin(const std::string& searchPath, const std::string& file) {
  namespace fs = std::filesystem;
  const fs::path name = file;
  std::vector<std::string> out;
  if (name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end()) return out;
  std::error_code none;
  for (const fs::path folder : foldersOf(searchPath))
    if (fs::is_regular_file(folder / name, none)) out.push_back((folder / name).string());
  return out;
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

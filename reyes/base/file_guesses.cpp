#include "reyes/base/file_guesses.h"

#include <algorithm>
#include <filesystem>

#include "reyes/base/search_path.h"

namespace tomales {

std::string lastPartOf(const std::string& name) {
  const size_t slash = name.find_last_of("/\\");
  return slash == std::string::npos ? "" : name.substr(slash + 1);
}

namespace {

constexpr size_t kLongestName = 4096;  // No file of Linux has a longer one.
constexpr size_t kMostParts = 16;      // Folders of a name of another machine that are tried.

std::vector<std::string> partsOf(const std::string& name) {
  std::vector<std::string> out(1);
  for (const char c : name)
    if (c != '/' && c != '\\')
      out.back() += c;
    else if (!out.back().empty())
      out.emplace_back();
  return out;
}

/// Returns the folders and all folders above them, each list from the inside.
std::vector<std::filesystem::path> withFoldersAbove(const std::vector<std::string>& folders) {
  namespace fs = std::filesystem;
  std::vector<fs::path> out;
  std::error_code none;
  for (const std::string& folder : folders)
    for (fs::path up = fs::weakly_canonical(folder, none); up.has_relative_path(); up = up.parent_path())
      out.push_back(up);
  return out;
}

}  // namespace

std::vector<std::string> pathSuffixes(const std::string& name, const std::vector<std::string>& folders) {
  namespace fs = std::filesystem;
  std::vector<std::string> out;
  if (name.size() > kLongestName) return out;
  std::error_code none;
  const std::vector<fs::path> above = withFoldersAbove(folders);
  const std::vector<std::string> parts = partsOf(name);
  const size_t least = fs::path(name).is_absolute() ? 1 : 0;
  for (size_t first = std::max(least, parts.size() - std::min(parts.size(), kMostParts)); first + 1 < parts.size();
       ++first) {
    fs::path end;
    for (size_t i = first; i < parts.size(); ++i) end /= parts[i];
    if (std::find(end.begin(), end.end(), "..") != end.end()) continue;
    for (const fs::path& up : above)
      if ((first == 0 || up.filename() == parts[first - 1]) && fs::is_directory((up / end).parent_path(), none))
        out.push_back((up / end).string());
    if (first > 0) out.push_back(end.string());
  }
  if (const std::string last = lastPartOf(name); !last.empty()) out.push_back(last);
  return out;
}

std::vector<std::string> candidateFiles(const std::string& name, const std::string& searchPath,
                                        const std::vector<std::string>& endings) {
  std::vector<std::string> out;
  const auto add = [&](const std::string& meant) {
    const std::string file = findFile(meant, searchPath);
    if (!file.empty() && std::find(out.begin(), out.end(), file) == out.end()) out.push_back(file);
  };
  std::vector<std::string> folders = foldersOf(searchPath);
  folders.push_back(".");
  std::vector<std::string> places = pathSuffixes(name, folders);
  places.insert(places.begin(), name);
  for (const std::string& place : places) {
    add(place);
    const std::string stem = std::filesystem::path(place).replace_extension().string();
    for (const std::string& ending : endings) add(stem.ends_with(ending) ? stem : stem + ending);
  }
  return out;
}

}  // namespace tomales

#include "reyes/base/search_path.h"

#include <algorithm>
#include <cstdlib>
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

// XDG Base Directory Specification: a relative XDG_CONFIG_HOME is to be ignored.
std::string userFolder(const std::string& name) {
  const auto folder = [](const char* variable) {
    const char* value = std::getenv(variable);
    return std::filesystem::path(value ? value : "");
  };
  const std::filesystem::path given = folder("XDG_CONFIG_HOME"), home = folder("HOME");
  if (given.is_absolute()) return (given / "tomales" / name).string();
  return home.is_absolute() ? (home / ".config/tomales" / name).string() : "";
}

namespace {

constexpr StandardPlace kPlaces[] = {{"shader", "TOMALES_SHADERS", "shaders"},
                                     {"texture", "TOMALES_TEXTURES", "textures"},
                                     {"archive", "TOMALES_ARCHIVES", "archives"}};

const StandardPlace* placeOf(const std::string& kind) {
  const auto it = std::find_if(std::begin(kPlaces), std::end(kPlaces), [&](const auto& p) { return p.kind == kind; });
  return it == std::end(kPlaces) ? nullptr : it;
}

}  // namespace

std::span<const StandardPlace> standardPlaces() { return kPlaces; }

std::string standardPath(const std::string& kind) {
  const StandardPlace* place = placeOf(kind);
  const char* variable = place ? std::getenv(place->variable) : nullptr;
  std::string out = variable ? variable : "";
  std::error_code none;
  if (const std::string own = place ? userFolder(place->folder) : ""; std::filesystem::is_directory(own, none))
    out += (out.empty() ? "" : ":") + own;
  return out;
}

void addToStandardPath(const std::string& kind, const std::string& folders) {
  const char* const variable = placeOf(kind)->variable;
  const char* const before = std::getenv(variable);
  setenv(variable, (folders + (before ? std::string(":") + before : "")).c_str(), 1);
}

}  // namespace tomales

#include "reyes/base/standard_folders.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace tomales {

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

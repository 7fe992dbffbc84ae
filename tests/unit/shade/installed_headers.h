// The headers of plugin writers, as a user has them.
#pragma once
#include <filesystem>
#include <sstream>
#include <string>

#include "places.h"

namespace tomales {

/// Copies the headers as `cmake --install` does.
inline void installHeaders(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "reyes/shader");
  std::istringstream headers(TOMALES_PLUGIN_HEADERS);
  for (std::string header; std::getline(headers, header, ':');)
    std::filesystem::copy(std::filesystem::path(TOMALES_SOURCE_DIR) / header, folder / header);
}

}  // namespace tomales

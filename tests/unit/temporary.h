// Where tests write files.
#pragma once
#include <filesystem>
#include <string>

namespace tomales::test {

/// Returns the path of a file in the folder that this process has for itself (tests/unit_main.cpp).
inline std::string temporary(const std::string& name) {
  return (std::filesystem::temp_directory_path() / name).string();
}

}  // namespace tomales::test

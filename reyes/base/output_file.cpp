#include "reyes/base/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace tomales {

std::string writeAtOnce(const std::string& path, const std::string& text) {
  namespace fs = std::filesystem;
  std::error_code problem;
  const fs::file_status there = fs::status(path, problem);
  if (fs::is_directory(there)) return std::strerror(EISDIR);
  const bool replaces = !fs::exists(there) || fs::is_regular_file(there);
  const std::string written = replaces ? fmt::format("{}.{}.part", path, ::getpid()) : path;
  errno = 0;
  std::ofstream file(written, std::ios::binary);
  file << text;
  file.close();
  problem.clear();
  if (!file) problem.assign(errno != 0 ? errno : EIO, std::generic_category());
  if (replaces && !problem) fs::rename(written, path, problem);
  std::error_code none;
  if (replaces && problem) fs::remove(written, none);
  return problem ? problem.message() : std::string();
}

}  // namespace tomales

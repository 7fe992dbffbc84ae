// A file as one text. Threads: plain function.
#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "reyes/base/input_file.h"

namespace tomales::model {

/// Returns the first `most` bytes of a file; nothing if it is empty or cannot be read.
inline std::string contentOf(const std::string& path, size_t most = std::numeric_limits<size_t>::max()) {
  std::ifstream in;
  std::error_code failed;
  if (inputProblem(path).empty()) in.open(path, std::ios::binary);
  const auto size = std::filesystem::file_size(path, failed);
  if (!in.is_open() || failed) return {};
  std::string out(std::min<size_t>(size, most), '\0');
  in.read(out.data(), static_cast<std::streamsize>(out.size()));
  out.resize(static_cast<size_t>(in.gcount()));
  return out;
}

}  // namespace tomales::model

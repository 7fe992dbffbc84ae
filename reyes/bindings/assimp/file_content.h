// A file as one text. Threads: plain function.
#pragma once
#include <fstream>
#include <iterator>
#include <string>

#include "reyes/base/input_file.h"

namespace tomales::model {

/// Empty: the file is empty or cannot be read.
inline std::string contentOf(const std::string& path) {
  std::ifstream in;
  if (inputProblem(path).empty()) in.open(path, std::ios::binary);
  return in.is_open() ? std::string(std::istreambuf_iterator<char>(in), {}) : std::string();
}

}  // namespace tomales::model

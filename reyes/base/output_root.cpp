#include "reyes/base/output_root.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "reyes/base/chunk_file.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {

std::string placeBelow(const std::string& root, const std::string& name) {
  namespace fs = std::filesystem;
  if (root.empty()) return name;
  std::error_code none;
  fs::create_directories(root, none);
  const fs::path folder = fs::canonical(root, none), place = fs::path(root) / name;
  const fs::path end = fs::weakly_canonical(throughLinks(fs::absolute(place, none)), none);
  const bool inside =
      !folder.empty() && std::mismatch(folder.begin(), folder.end(), end.begin(), end.end()).first == folder.end();
  if (!inside)
    throw WriteError(
        fmt::format("\"{}\" would lie outside of \"{}\", where --output-root keeps what a scene writes", name, root));
  fs::create_directories(end.parent_path(), none);  // opening the file will report a failure
  return place.string();
}

}  // namespace tomales

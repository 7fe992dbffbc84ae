#include "reyes/base/temporary_folder.h"

#include <stdlib.h>  // NOLINT: mkdtemp is POSIX

#include <cerrno>

namespace tomales {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(const fs::path& parent) {
  std::string name = (parent / "tomales_XXXXXX").string();
  if (!::mkdtemp(name.data()))
    throw fs::filesystem_error("a temporary folder cannot be made", parent, {errno, std::generic_category()});
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
}

}  // namespace tomales

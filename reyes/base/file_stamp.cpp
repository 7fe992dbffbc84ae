#include "reyes/base/file_stamp.h"

#include "reyes/base/pack.h"

namespace tomales {

namespace fs = std::filesystem;

uint64_t fileStamp(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return 0;
  return contentSum(fs::file_size(path, error), fs::last_write_time(path, error).time_since_epoch().count());
}

}  // namespace tomales

#include "reyes/rib/zip_member.h"

#include <zip.h>

#include <filesystem>
#include <memory>
#include <string>

namespace tomales::rib {

std::string zipOf(const std::string& path) {
  std::error_code none;
  for (size_t at = path.find('!'); at != std::string::npos && at + 1 < path.size(); at = path.find('!', at + 1))
    if (std::string zip = path.substr(0, at); std::filesystem::is_regular_file(zip, none)) return zip;
  return "";
}

ZipSource openZipMember(const std::string& path, size_t harmless_bytes, size_t largestRatio, std::string& why) {
  const auto refuse = [&](std::string reason) {
    why = std::move(reason);
    return ZipSource();
  };
  const std::string zip = zipOf(path);
  if (zip.empty()) return refuse("there is no such zip file");
  const std::shared_ptr<zip_t> archive(zip_open(zip.c_str(), ZIP_RDONLY, nullptr), [](zip_t* z) {
    if (z) zip_discard(z);
  });
  if (!archive) return refuse(zip + " is no zip file, or damaged");
  const std::string member = path.substr(zip.size() + 1);
  zip_stat_t stat;
  if (zip_stat(archive.get(), member.c_str(), 0, &stat) != 0) return refuse(zip + " holds no file of that name");
  const bool sized = (stat.valid & ZIP_STAT_SIZE) && (stat.valid & ZIP_STAT_COMP_SIZE);
  if (!sized || (stat.size > harmless_bytes && stat.size / largestRatio > stat.comp_size))
    return refuse("it swells beyond " + std::to_string(harmless_bytes >> 20) + " MiB and " +
                  std::to_string(largestRatio) + " times its size");
  const std::shared_ptr<zip_file_t> file(zip_fopen(archive.get(), member.c_str(), 0), [archive](zip_file_t* f) {
    if (f) zip_fclose(f);
  });
  if (!file) return refuse("it is packed in a way that is not known, or encrypted");
  return [file](char* buffer, size_t size) {
    const zip_int64_t n = zip_fread(file.get(), buffer, size);
    return n < 0 ? kBrokenZip : static_cast<size_t>(n);
  };
}

}  // namespace tomales::rib

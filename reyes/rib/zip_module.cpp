// The module over libzip: only this file includes that library, which brings OpenSSL.
#include "reyes/rib/zip_module.h"

#include <zip.h>

#include <memory>

extern "C" __attribute__((visibility("default"))) tomales::rib::ZipSource tomalesOpenZipMember(
    const std::string& zip, const std::string& member, size_t harmless_bytes, size_t largestRatio, std::string& why) {
  using namespace tomales::rib;
  const auto refuse = [&](std::string reason) {
    why = std::move(reason);
    return ZipSource();
  };
  const std::shared_ptr<zip_t> archive(zip_open(zip.c_str(), ZIP_RDONLY, nullptr), [](zip_t* z) {
    if (z) zip_discard(z);
  });
  if (!archive) return refuse(zip + " is no zip file, or damaged");
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

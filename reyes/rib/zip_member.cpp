#include "reyes/rib/zip_member.h"

#include <filesystem>

#include "reyes/base/module.h"
#include "reyes/rib/zip_module.h"

namespace tomales::rib {

std::string zipOf(const std::string& path) {
  std::error_code none;
  for (size_t at = path.find('!'); at != std::string::npos && at + 1 < path.size(); at = path.find('!', at + 1))
    if (std::string zip = path.substr(0, at); std::filesystem::is_regular_file(zip, none)) return zip;
  return "";
}

ZipSource openZipMember(const std::string& path, size_t harmless_bytes, size_t largestRatio, std::string& why) {
  const std::string zip = zipOf(path);
  if (zip.empty()) {
    why = "there is no such zip file";
    return {};
  }
  static const ModuleFunction<OpenZipMember> open("libtomales_zip.so", "tomalesOpenZipMember");
  if (open.call) return open.call(zip, path.substr(zip.size() + 1), harmless_bytes, largestRatio, why);
  why = open.error;
  return {};
}

}  // namespace tomales::rib

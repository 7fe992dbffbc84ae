// Private to reyes/rib: the only function of the module over libzip.
#pragma once
#include "reyes/rib/zip_member.h"

namespace tomales::rib {

/// openZipMember(), with the names of the zip file and of its member apart.
using OpenZipMember = ZipSource(const std::string& zip, const std::string& member, size_t harmless_bytes,
                                size_t largestRatio, std::string& why);

}  // namespace tomales::rib

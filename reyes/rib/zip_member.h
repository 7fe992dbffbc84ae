// Files within zip files, which PRMan 20 and RenderMan for Maya name "archives.zip!name.rib".
#pragma once
#include <cstddef>
#include <functional>
#include <string>

namespace tomales::rib {

/// Returns the part before the '!' if that is a file, and an empty name otherwise.
std::string zipOf(const std::string& path);

/// Reads bytes of a member. Returns 0 at its end, and kBrokenZip if the rest cannot be unpacked or its checksum is
/// wrong.
using ZipSource = std::function<size_t(char* buffer, size_t size)>;
constexpr size_t kBrokenZip = static_cast<size_t>(-1);

/// Returns an empty source, and `why` in a few words, if there is no such zip file or member, or if it unpacks to more
/// than both `harmless_bytes` and `largestRatio` times its size. Threads: each source belongs to its reader.
ZipSource openZipMember(const std::string& path, size_t harmless_bytes, size_t largestRatio, std::string& why);

}  // namespace tomales::rib

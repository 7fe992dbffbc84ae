// A number that shows whether a file has changed, without reading it. Threads: any.
#pragma once
#include <cstdint>
#include <filesystem>

namespace tomales {

/// Returns a checksum of the file's size and the time of its last change; 0 if there is no such file.
uint64_t fileStamp(const std::filesystem::path& path);

}  // namespace tomales

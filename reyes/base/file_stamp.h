// What tells a file from what it was before, without reading it.
// Threads: any.
#pragma once
#include <cstdint>
#include <filesystem>

namespace tomales {

/// Of its size and the time of its last change; 0: there is no such file.
uint64_t fileStamp(const std::filesystem::path& path);

}  // namespace tomales

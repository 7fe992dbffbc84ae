// What this process takes of the machine.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tomales {

/// Memory in bytes: now, and the most that there ever was.
int64_t residentBytes();
int64_t peakResidentBytes();

/// What has been freed goes back to the machine; else the allocator keeps most of it. Takes milliseconds.
void returnFreeMemory();

/// Where a file of this name is that belongs to the program: beside it, as built, or in lib, as installed. Those that
/// exist.
std::vector<std::filesystem::path> besideProgram(const std::string& name);

}  // namespace tomales

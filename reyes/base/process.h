// The memory of this process, the files beside its program, and its machine.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tomales {

/// Return resident memory in bytes: now, and at its peak.
int64_t residentBytes();
int64_t peakResidentBytes();
/// Resets the peak to the present amount, where the system supports this.
void restartPeak();

/// Lets the allocator keep freed memory for later use (docs/decisions/0189), in threads that start later too.
void keepFreedMemory();
/// Gives freed memory back to the system, of which the allocator keeps most otherwise. It takes milliseconds.
void returnFreeMemory();

/// Returns the machine's name; empty if it has none.
std::string hostName();
/// Returns the time in UTC, as ISO 8601 writes it, to the second.
std::string timeNow();

/// Returns the paths where a file of this name that belongs to the program exists: beside the program, as it is built,
/// or in lib/tomales, as it is installed.
std::vector<std::filesystem::path> besideProgram(const std::string& name);

}  // namespace tomales

// The memory of this process, the files beside its program, and its machine.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tomales {

/// Return memory in bytes: the present amount, and the greatest that there ever was.
int64_t residentBytes();
int64_t peakResidentBytes();
/// Lets the peak begin again at the present amount, where the system can.
void restartPeak();

/// Lets the allocator keep what is freed for what comes next (docs/decisions/0189); later threads have its settings
/// too.
void keepFreedMemory();
/// Gives freed memory back to the system; else the allocator keeps most of it. It takes milliseconds.
void returnFreeMemory();

/// Returns the machine's name; empty if it has none.
std::string hostName();
/// Returns the time in UTC, as ISO 8601 writes it, to the second.
std::string timeNow();

/// Returns the paths where a file of this name that belongs to the program exists: beside the program, as it is built,
/// or in lib/tomales, as it is installed.
std::vector<std::filesystem::path> besideProgram(const std::string& name);

}  // namespace tomales

// What this process takes of the machine.
#pragma once
#include <cstdint>

namespace tomales {

/// Memory in bytes: now, and the most that there ever was.
int64_t residentBytes();
int64_t peakResidentBytes();

/// What has been freed goes back to the machine; else the allocator keeps most of it. Takes milliseconds.
void returnFreeMemory();

}  // namespace tomales

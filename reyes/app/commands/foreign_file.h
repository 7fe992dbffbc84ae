// Files of other formats that are given where a RIB file is wanted.
#pragma once
#include <string>
#include <vector>

#include "reyes/base/log.h"

namespace tomales {

/// Tells whether the file is of a kind that holds no RIB, by its extension or, for a picture, by its first bytes. If
/// so, this is reported, with the kind and with what can be done with the file.
bool isForeign(const std::string& file, Log& log);
bool isAnyForeign(const std::vector<std::string>& files, Log& log);

/// Tells whether the file is a picture, by its extension or by its first bytes.
bool isPicture(const std::string& file);

}  // namespace tomales

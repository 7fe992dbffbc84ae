// Files of other formats that are given where a RIB file is wanted.
#pragma once
#include <string>
#include <vector>

#include "reyes/base/log.h"

namespace tomales {

/// Tells whether the file, by the ending of its name or as a picture by its first bytes, is of a kind that holds no
/// RIB. If so, it is reported, with its kind and what can be done with it.
bool isForeign(const std::string& file, Log& log);
bool isAnyForeign(const std::vector<std::string>& files, Log& log);

/// Tells whether the file is a picture, by the ending of its name or by its first bytes.
bool isPicture(const std::string& file);

}  // namespace tomales

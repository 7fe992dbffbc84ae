// Private to reyes/vdb: the module's only function.
#pragma once
#include "reyes/vdb.h"

namespace tomales {

using ReadVdb = std::unique_ptr<DensityGrid>(const std::string& path, const std::string& grid, const Bound3& bound,
                                             std::vector<std::string>& notes, std::string& error);

}  // namespace tomales

// Verb: reads densities of OpenVDB files. The library lives in a module of its own (reyes/vdb/module.cpp), which is
// loaded for the first such file: docs/decisions/0166-volumes.md. Threads: calls may be concurrent.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "reyes/density.h"

namespace tomales {

/// Reads the grid of that name, which holds floats and stands still; its values count within `bound`, a box of object
/// space. Level sets become 1 inside and 0 outside, linear over their band. ":fogvolume" or ":levelset" behind the name
/// gives the kind of the grid. Returns null on failure, and `error` says why, without the file's name. `notes` gets
/// other messages for the user.
std::unique_ptr<DensityGrid> readVdb(const std::string& path, const std::string& grid, const Bound3& bound,
                                     std::vector<std::string>& notes, std::string& error);

}  // namespace tomales

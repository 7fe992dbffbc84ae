#include "reyes/base/input_file.h"
#include "reyes/base/module.h"
#include "reyes/vdb.h"
#include "reyes/vdb/module.h"

namespace tomales {

std::unique_ptr<DensityGrid> readVdb(const std::string& path, const std::string& grid, const Bound3& bound,
                                     std::vector<std::string>& notes, std::string& error) {
  error = inputProblem(path);
  if (!error.empty()) return nullptr;
  static const ModuleFunction<ReadVdb> read("libtomales_openvdb.so", "tomalesReadVdb");
  if (read.call) return read.call(path, grid, bound, notes, error);
  error = read.error;
  return nullptr;
}

}  // namespace tomales

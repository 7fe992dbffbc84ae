#include "reyes/base/input_file.h"
#include "reyes/base/module.h"
#include "reyes/vdb.h"
#include "reyes/vdb/module.h"

namespace tomales {

std::unique_ptr<DensityGrid> readVdb(const std::string& path, const std::string& grid, const Bound3& bound,
                                     std::vector<std::string>& notes, std::string& error) {
  error = inputProblem(path);
  if (!error.empty()) return nullptr;
  static const VdbModule module = [] {
    VdbModule out;
    out.read = reinterpret_cast<ReadVdb*>(moduleFunction("libtomales_openvdb.so", "tomalesReadVdb", out.error));
    return out;
  }();
  if (!module.read) {
    error = module.error;
    return nullptr;
  }
  return module.read(path, grid, bound, notes, error);
}

}  // namespace tomales

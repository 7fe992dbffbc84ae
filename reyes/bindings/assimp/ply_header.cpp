#include "reyes/bindings/assimp/ply_header.h"

#include <fstream>
#include <sstream>

namespace tomales::model {

bool hasColorsOfFaces(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  bool isFace = false;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind, of, name;
    words >> kind >> of >> name;
    if (kind == "end_header") break;
    if (kind == "element") isFace = of == "face";
    if (isFace && kind == "property" && name == "red") return true;
  }
  return false;
}

}  // namespace tomales::model

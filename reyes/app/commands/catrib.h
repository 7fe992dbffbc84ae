// tomales catrib: copies RIB in another encoding.
#pragma once
#include <string>
#include <vector>

#include "reyes/app/exit_code.h"

namespace tomales {

struct CatribSettings {
  std::vector<std::string> files;  ///< The files of one stream; "-" is standard input.
  std::string output;              ///< If empty, it is standard output.
  bool binary = false, gzip = false;
};

int catribCommand(const CatribSettings& settings);

}  // namespace tomales

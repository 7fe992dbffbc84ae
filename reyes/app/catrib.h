// tomales catrib: RIB in, RIB out, in another encoding.
#pragma once
#include <string>
#include <vector>

#include "reyes/app/exit_code.h"

namespace tomales {

struct CatribSettings {
  std::vector<std::string> files;  ///< One stream; "-" is standard input.
  std::string output;              ///< Empty: standard output.
  bool binary = false, gzip = false;
};

int catribCommand(const CatribSettings& settings);

}  // namespace tomales

// The files beside a RIB that it names. Threads: plain object.
#pragma once
#include <string>

#include "reyes/bindings/assimp/rib_calls.h"
#include "reyes/bindings/assimp/settings.h"

namespace tomales::model {

/// Writes a whole file. Throws WriteError.
void writePart(const std::string& path, const std::string& bytes);

class Parts {
 public:
  explicit Parts(const Settings& settings) : settings_(settings) {}

  struct Place {
    std::string path;  ///< Path to write to.
    std::string name;  ///< Name in the RIB.
  };
  /// Returns a new file in the folder of parts, with a name made from `stem`, which may be any text.
  Place reserve(const std::string& stem, const std::string& ending);
  /// Writes the requests as binary RIB. Returns the name of the file in the RIB.
  std::string addArchive(const std::string& stem, const Requests& requests);

 private:
  const Settings& settings_;
  int count_ = 0;
};

}  // namespace tomales::model

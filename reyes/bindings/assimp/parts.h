// The files beside a RIB that it names. Threads: plain object.
#pragma once
#include <string>
#include <string_view>

#include "reyes/bindings/assimp/rib_calls.h"
#include "reyes/bindings/assimp/settings.h"

namespace tomales::model {

/// A text written whole. Throws WriteError.
void writePart(const std::string& path, std::string_view bytes);

class Parts {
 public:
  explicit Parts(const Settings& settings) : settings_(settings) {}

  /// Writes a file into the folder of parts under a name made of `stem`, which may be anything, and returns what the
  /// RIB calls it.
  std::string add(const std::string& stem, const std::string& ending, std::string_view bytes);
  /// The requests as binary RIB.
  std::string addArchive(const std::string& stem, const Requests& requests);

 private:
  const Settings& settings_;
  int count_ = 0;
};

}  // namespace tomales::model

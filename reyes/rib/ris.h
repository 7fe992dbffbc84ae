// Requests of the RIS era of PRMan -> requests that say nearly the same with what Tomales has.
#pragma once
#include "reyes/rib.h"

namespace tomales::rib {

struct Translation {
  std::vector<Request> requests;
  std::string note;  ///< What stands in for what.
  Severity severity = Severity::Warning;
};

bool isRis(std::string_view name);
/// Pre: isRis(request.name).
Translation translateRis(const Request& request);

}  // namespace tomales::rib

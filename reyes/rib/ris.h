// Requests of the RIS era of PRMan -> requests that say nearly the same with what Tomales has.
#pragma once
#include "reyes/rib.h"

namespace tomales::rib {

/// What stands in for what; said once for each key.
struct Note {
  std::string key, text;
  SourceLoc where;
  Severity severity = Severity::Warning;
  const char* code = "rib-substitute";
};

struct Translation {
  std::vector<Request> requests;
  std::vector<Note> notes;
};

/// Pattern requests by handle: the parameters of others refer to their outputs.
using Patterns = std::map<std::string, Request>;

bool isRis(const Request& request);
/// Pre: isRis(request).
Translation translateRis(const Request& request, Patterns& patterns);

/// What Tomales calls the source of a channel ("normal Nn", "color lpe:C<RD>[<L.>O]"), without its type; unknown ones
/// stay.
std::string risSource(const std::string& source);

}  // namespace tomales::rib

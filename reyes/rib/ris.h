// Translates requests of the RIS era of PRMan to requests that say nearly the same in terms of Tomales.
#pragma once
#include <optional>

#include "reyes/rib.h"

namespace tomales::rib {

/// Tells what was replaced by what; it is reported once for each key.
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

/// What requests of the RIS era leave for later ones.
struct RisState {
  Patterns patterns;
  std::optional<Request> areaLight;  ///< The latest AreaLightSource of PRMan 19 and 20; its shape may follow.
  std::optional<Request> bxdf;       ///< The first Bxdf.
  bool hasLight = false;             ///< True after a light, also one that is not available.
  bool hasIntegrator = false;        ///< True after an Integrator other than PxrDefault.
};

bool isRis(const Request& request);
/// Pre: isRis(request).
Translation translateRis(const Request& request, RisState& state);
/// Returns the lamp at the eye of PxrDefault, which lights a world without lights. PxrDefault is the Integrator where
/// none is named. Empty if another one is, or if nothing has a Bxdf.
Translation headLamp(const RisState& state);

/// Returns the name that Tomales has for the source of a channel ("normal Nn", "color lpe:C<RD>[<L.>O]"), without its
/// type; unknown sources stay as they are.
std::string risSource(const std::string& source);

}  // namespace tomales::rib

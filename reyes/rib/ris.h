// Translates requests of the RIS era of PRMan to nearly equivalent requests that Tomales knows.
#pragma once
#include <optional>

#include "reyes/rib.h"

namespace tomales::rib {

/// A message about a replacement. It is reported once for each key.
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

/// Requests by handle: the parameters of others refer to them.
using Nodes = std::map<std::string, Request>;

/// What requests of the RIS era leave for later ones.
struct RisState {
  Nodes patterns, bxdfs;
  std::optional<Request> areaLight;  ///< The latest AreaLightSource of PRMan 19 and 20; its shape may follow.
  std::optional<Request> bxdf;       ///< The first Bxdf.
  bool hasLight = false;             ///< True after a light, also one that is not available.
  bool hasIntegrator = false;        ///< True after an Integrator other than PxrDefault.
};

bool isRis(const Request& request);
/// Pre: isRis(request).
Translation translateRis(const Request& request, RisState& state);
/// Returns the lamp at the eye of PxrDefault, which lights a world without lights. PxrDefault is the Integrator unless
/// the scene names one. Returns nothing if another one is named, or if nothing has a Bxdf.
Translation headLamp(const RisState& state);

/// Returns Tomales' name for the source of a channel ("normal Nn", "color lpe:C<RD>[<L.>O]"), without its type. An
/// unknown source is returned unchanged.
std::string risSource(const std::string& source);

}  // namespace tomales::rib

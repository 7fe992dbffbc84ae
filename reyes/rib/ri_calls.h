// Turns calls of the C binding (reyes/ri.h) into Requests.
#pragma once
#include <functional>
#include <mutex>
#include <optional>

#include "reyes/ri.h"
#include "reyes/rib.h"
#include "reyes/rib/dictionary.h"

namespace tomales::rib {

/// An RiProcedural with a function of the caller's own.
struct OwnProcedural {
  std::shared_ptr<void> data;  ///< Freed by the caller's function with the last copy.
  RtProcSubdivFunc subdivide;
};

struct RiCall {
  Request request;
  std::optional<OwnProcedural> procedural;
};

/// The state in which calls are understood.
struct RiContext {
  Dictionary dictionary;
  int uStep = 3, vStep = 3;  ///< Steps of the bases.
  SourceLoc where;           ///< The place that the requests are given.
};

/// Runs `program` and records the calls that it makes in this thread. Exceptions of `program` are not caught; `calls`
/// then has those that came before.
void recordRiCalls(RiContext context, Log& log, const std::function<void()>& program, std::vector<RiCall>& calls);

/// Plugins were not written for threads: hold this while their code runs.
std::recursive_mutex& pluginMutex();

}  // namespace tomales::rib

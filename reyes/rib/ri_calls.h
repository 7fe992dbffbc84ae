// Calls of the C binding (reyes/ri.h) -> Requests.
#pragma once
#include <functional>
#include <mutex>
#include <optional>

#include "reyes/ri.h"
#include "reyes/rib.h"
#include "reyes/rib/dictionary.h"

namespace tomales::rib {

/// RiProcedural with a function of the caller's own.
struct OwnProcedural {
  std::shared_ptr<void> data;  ///< Freed by the caller's function with the last copy.
  RtProcSubdivFunc subdivide;
};

struct RiCall {
  Request request;
  std::optional<OwnProcedural> procedural;
};

/// How calls are understood.
struct RiContext {
  Dictionary dictionary;
  int uStep = 3, vStep = 3;  ///< Of the bases.
  SourceLoc where;           ///< What the requests say of their place.
};

/// Runs `program` and takes down the calls that it makes in this thread. What it throws goes on; `calls` holds what
/// came before.
void recordRiCalls(RiContext context, Log& log, const std::function<void()>& program, std::vector<RiCall>& calls);

/// Plugins were not written for threads: what runs their code holds this.
std::recursive_mutex& pluginMutex();

}  // namespace tomales::rib

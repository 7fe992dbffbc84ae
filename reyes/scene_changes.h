// Changes to all attributes of a scene that has been read, before it is used.
// Threads: one; what procedurals hold is changed by whoever opens them.
#pragma once
#include <functional>

#include "reyes/scene.h"

namespace tomales {

/// Gives each object a changed copy of its attributes, and what procedurals hold, when they are opened: `change` may be
/// called by any thread, as long as the scene lives. Objects that shared attributes keep sharing.
void changeAttributes(Scene& scene, const std::function<void(Attributes&)>& change);

}  // namespace tomales

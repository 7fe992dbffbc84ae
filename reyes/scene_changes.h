// Changes to all attributes of a scene that has been read, before it is used. Threads: one may call it; the contents of
// procedurals are changed by the threads that open them.
#pragma once
#include <functional>

#include "reyes/scene.h"

namespace tomales {

/// Gives each object a changed copy of its attributes, and the contents of procedurals when they are opened: any thread
/// may call `change`, as long as the scene lives. Objects that shared attributes keep sharing.
void changeAttributes(Scene& scene, const std::function<void(Attributes&)>& change);

}  // namespace tomales

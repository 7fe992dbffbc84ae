// Changes to all attributes of a scene that has been read, before it is used. Threads: one may call it; the contents of
// procedurals are changed by the threads that expand them.
#pragma once
#include <functional>

#include "reyes/scene.h"

namespace tomales {

/// Gives each object a changed copy of its attributes. Objects in procedurals get theirs when the procedurals are
/// expanded, so any thread may call `change` as long as the scene lives. Objects that shared attributes keep sharing.
void changeAttributes(Scene& scene, const std::function<void(Attributes&)>& change);

/// Tells whether the object is displaced, and nobody has said if rays see that (Attribute "trace" "displacements").
bool leavesDisplacementOpen(const Attributes& attributes);
/// Returns a copy of such attributes with which rays see the displacement. The tessellation for rays is `finer` times
/// as fine.
std::shared_ptr<const Attributes> withDisplacementForRays(const Attributes& attributes, float finer);
/// Undoes the choice that rays see displacements. That choice depends on the size of the picture, and the checksum of a
/// world must not.
std::shared_ptr<const Attributes> asTheSceneSays(const std::shared_ptr<const Attributes>& attributes);

}  // namespace tomales

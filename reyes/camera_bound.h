// Bounds objects as the camera sees them.
#pragma once
#include "reyes/scene.h"

namespace tomales {

/// Returns the space that the object may fill during its motion, in camera space. Empty if it has no shapes
/// (hasGeometry()).
Bound3 cameraBound(const Object& object);

}  // namespace tomales

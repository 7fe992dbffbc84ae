// Where an object may be, as the camera sees it.
#pragma once
#include "reyes/scene.h"

namespace tomales {

/// What the object may fill over its motion, in camera space; empty: it has no shapes (hasGeometry()).
Bound3 cameraBound(const Object& object);

}  // namespace tomales

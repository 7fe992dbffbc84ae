// Private to the frame: the names of objects and materials for Cryptomatte.
#pragma once
#include "reyes/image.h"

namespace tomales {

/// Names of objects are Attribute "identifier" "name"; names of materials are "shadinggroup" or their surface shader.
MatteNames matteNames(const Scene& scene);

}  // namespace tomales

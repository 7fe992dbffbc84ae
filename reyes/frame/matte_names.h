// Private to the frame: the names that Cryptomatte gives to what is seen.
#pragma once
#include "reyes/image.h"

namespace tomales {

/// Names of objects are Attribute "identifier" "name"; names of materials are "shadinggroup" or their surface shader.
MatteNames matteNames(const Scene& scene);

}  // namespace tomales

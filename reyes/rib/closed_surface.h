// Tests whether several objects together bound a volume.
#pragma once
#include <span>

#include "reyes/scene.h"

namespace tomales::rib {

/// Returns an object with an open edge that no edge of the others, or of itself elsewhere, runs along; null if there is
/// none. It judges by points on the edges at the first motion key, to a hundredth of the size of the whole. Meshes with
/// too many edges to test count as closed.
const Object* findOpenEdge(std::span<const Object> objects);

}  // namespace tomales::rib

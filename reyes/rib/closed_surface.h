// Tests whether several objects together bound a volume, and which way their normals point.
#pragma once
#include <span>

#include "reyes/scene.h"

namespace tomales::rib {

/// Returns an object with an open edge along which no other edge runs, of any object; null if there is none. It
/// compares points on the edges at the first motion key, within a hundredth of the size of the whole. Meshes with too
/// many edges to compare count as closed.
const Object* findOpenEdge(std::span<const Object> objects);

/// Sets Object::turnedInSolid by the edges along which objects are joined. Where normals agree, a walk around one
/// object and a walk around the other run against each other along a common edge. It compares edges as findOpenEdge()
/// does.
void findTurned(std::span<Object> objects);

}  // namespace tomales::rib

// Private to reyes/dfb: the fields of a Scene that a .dfb holds, which are all but geometry. When a structure gains a
// field, this file no longer compiles: add the field to the list, and nothing else needs to be done.
#pragma once
#include "reyes/dfb.h"
#include "reyes/state_fields.h"

namespace tomales {

template <class A, class T>
void field(A& a, StableVector<T>& x) {
  std::vector<T> elements(x.begin(), x.end());
  field(a, elements);
  if constexpr (kUnpacks<A>) {
    x.clear();
    for (T& element : elements) x.push_back(std::move(element));
  }
}

template <class A>
void fields(A& a, PixelRect& x) {
  auto& [x0, y0, x1, y1] = x;
  each(a, x0, y0, x1, y1);
}

template <class A>
void fields(A& a, Primvar& x) {
  auto& [name, storage, type, width, values] = x;
  each(a, name, storage, type, width, values);
}

template <class A>
void fields(A& a, ShadeGroup& x) {
  auto& [attributes, cameraFromObject, primvars, exampleObject, where, currentFromOpen, solid, subtracted, steps] = x;
  each(a, attributes, cameraFromObject, primvars, exampleObject, where, currentFromOpen, solid, subtracted, steps);
}

/// Packs the fields that withoutGeometry() keeps. The private members serve geometry alone, so no structured binding
/// guards this list.
template <class A>
void fields(A& a, Scene& x) {
  each(a, x.options, x.cameraFromWorld, x.lights, x.worldFromNamed, x.worldFromOpenings, x.where, x.groups);
  std::vector<SourceLoc> places;
  for (const Object& o : x.objects) places.push_back(o.where);
  field(a, places);
  if constexpr (kUnpacks<A>) {
    for (size_t i = 0; i < std::min(x.groups.size(), places.size()); ++i) {
      Object o;
      o.attributes = x.groups[i].attributes;
      o.where = places[i];
      o.group = static_cast<int>(i);
      x.objects.push_back(std::move(o));
    }
  }
}

template <class A>
void fields(A& a, SourceFile& x) {
  auto& [path, sum] = x;
  each(a, path, sum);
}

/// Packs the layout alone: tiles are records of their own.
template <class A>
void fields(A& a, DeepFrame& x) {
  auto& [crop, padded, bucketWidth, bucketHeight, columns, rows, samplesPerPixel, complete, tiles, firstRow] = x;
  each(a, crop, padded, bucketWidth, bucketHeight, columns, rows, samplesPerPixel, complete);
}

template <class A>
void fields(A& a, Shot& x) {
  auto& [scene, frame, seed, sources, folder, world] = x;
  each(a, scene, frame, seed, sources, folder, world);
}

}  // namespace tomales

// Which fields of a Scene a .dfb holds: all but geometry. Private to reyes/dfb. A structure that gains a field stops the
// compiler here: add it to the list, and nothing else needs to be done.
#pragma once
#include "reyes/base/pack.h"
#include "reyes/dfb.h"

namespace tomales {

template <class A>
void fields(A& a, PixelRect& x) {
  auto& [x0, y0, x1, y1] = x;
  each(a, x0, y0, x1, y1);
}

template <class A>
void fields(A& a, SourceLoc& x) {
  auto& [file, line] = x;
  each(a, file, line);
}

template <class A>
void fields(A& a, Param& x) {
  auto& [name, storage, type, arrayLength, floats, ints, strings] = x;
  each(a, name, storage, type, arrayLength, floats, ints, strings);
}

template <class A>
void fields(A& a, Motion& x) {
  auto& [times, keys] = x;
  each(a, times, keys);
}

template <class A>
void fields(A& a, ShaderCall& x) {
  auto& [name, params, worldFromShader, where] = x;
  each(a, name, params, worldFromShader, where);
}

template <class A>
void fields(A& a, LightCall& x) {
  auto& [shader, handle, area, castsShadows, index] = x;
  each(a, shader, handle, area, castsShadows, index);
}

template <class A>
void fields(A& a, DisplayCall& x) {
  auto& [name, type, mode, params, where] = x;
  each(a, name, type, mode, params, where);
}

template <class A>
void fields(A& a, Quantize& x) {
  auto& [one, min, max, dither] = x;
  each(a, one, min, max, dither);
}

template <class A>
void fields(A& a, Options& x) {
  auto& [xResolution, yResolution, pixelAspect, frameAspect, screenWindow, cropWindow, projection, fov, nearClip, farClip,
         shutterOpen, shutterClose, fStop, focalLength, focalDistance, xSamples, ySamples, filter, xFilterWidth,
         yFilterWidth, exposureGain, exposureGamma, rgbaQuantize, depthQuantize, quantizeGiven, displays, imager,
         bucketWidth, bucketHeight, bucketOrder, gridSize, hider, jitter, frame, searchPaths, user] = x;
  each(a, xResolution, yResolution, pixelAspect, frameAspect, screenWindow, cropWindow, projection, fov, nearClip, farClip,
       shutterOpen, shutterClose, fStop, focalLength, focalDistance, xSamples, ySamples, filter, xFilterWidth,
       yFilterWidth, exposureGain, exposureGamma, rgbaQuantize, depthQuantize, quantizeGiven, displays, imager,
       bucketWidth, bucketHeight, bucketOrder, gridSize, hider, jitter, frame, searchPaths, user);
}

template <class A>
void fields(A& a, Visibility& x) {
  auto& [camera, diffuse, specular, transmission, photon] = x;
  each(a, camera, diffuse, specular, transmission, photon);
}

template <class A>
void fields(A& a, Attributes::Trace& x) {
  auto& [bias, offset, displacements, tessellation] = x;
  each(a, bias, offset, displacements, tessellation);
}

template <class A>
void fields(A& a, Attributes::Indirect& x) {
  auto& [receive, gain, bleeding, bleedingColor, surface] = x;
  each(a, receive, gain, bleeding, bleedingColor, surface);
}

template <class A>
void fields(A& a, Attributes& x) {
  auto& [color, opacity, textureCoordinates, shadingRate, motionFactor, focusFactor, interpolation, matte, sides, insideOut,
         name, surface, displacement, atmosphere, lights, areaLight, displacementBound, displacementBoundSpace, visibility,
         trace, indirect, irradianceMaxError, irradianceMaxPixelDist, rasterOrient, user] = x;
  each(a, color, opacity, textureCoordinates, shadingRate, motionFactor, focusFactor, interpolation, matte, sides, insideOut,
       name, surface, displacement, atmosphere, lights, areaLight, displacementBound, displacementBoundSpace, visibility,
       trace, indirect, irradianceMaxError, irradianceMaxPixelDist, rasterOrient, user);
}

template <class A>
void fields(A& a, Primvar& x) {
  auto& [name, storage, type, width, values] = x;
  each(a, name, storage, type, width, values);
}

template <class A>
void fields(A& a, ShadeGroup& x) {
  auto& [attributes, cameraFromObject, primvars, exampleObject] = x;
  each(a, attributes, cameraFromObject, primvars, exampleObject);
}

/// Packs what `withoutGeometry` leaves.
template <class A>
void fields(A& a, Scene& x) {
  auto& [options, cameraFromWorld, objects, lights, worldFromNamed, where, groups] = x;
  each(a, options, cameraFromWorld, lights, worldFromNamed, where, groups);
  std::vector<SourceLoc> places;
  for (const Object& o : objects) places.push_back(o.where);
  field(a, places);
  if constexpr (kUnpacks<A>) {
    for (size_t i = 0; i < std::min(groups.size(), places.size()); ++i) {
      Object& o = objects.emplace_back();
      o.attributes = groups[i].attributes, o.where = places[i], o.group = static_cast<int>(i);
    }
  }
}

template <class A>
void fields(A& a, SourceFile& x) {
  auto& [path, sum] = x;
  each(a, path, sum);
}

/// The rectangles of tiles follow from the rest.
template <class A>
void fields(A& a, DeepFrame& x) {
  auto& [crop, padded, bucketWidth, bucketHeight, columns, rows, samplesPerPixel, complete, tiles] = x;
  each(a, crop, padded, bucketWidth, bucketHeight, columns, rows, samplesPerPixel, complete);
}

template <class A>
void fields(A& a, Shot& x) {
  auto& [scene, frame, seed, sources, folder, world] = x;
  each(a, scene, frame, seed, sources, folder, world);
}

}  // namespace tomales

// Which fields of a Scene a .dfb holds: all but geometry. Private to reyes/dfb. A structure that gains a field stops the
// compiler here: add it to the list, and nothing else needs to be done.
#pragma once
#include "reyes/base/pack.h"
#include "reyes/dfb.h"

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
  auto& [one, min, max, dither, zero] = x;
  each(a, one, min, max, dither, zero);
}

template <class A>
void fields(A& a, ChannelCall& x) {
  auto& [name, type, params, where] = x;
  each(a, name, type, params, where);
}

template <class A>
void fields(A& a, Aperture& x) {
  auto& [sides, angle, roundness, density] = x;
  each(a, sides, angle, roundness, density);
}

template <class A>
void fields(A& a, Options& x) {
  auto& [xResolution, yResolution, pixelAspect, frameAspect, screenWindow, cropWindow, projection, fov, nearClip, farClip,
         shutterOpen, shutterClose, shutterOffset, sampleMotion, fStop, focalLength, focalDistance, aperture, dofAspect, xSamples,
         ySamples, filter, xFilterWidth, yFilterWidth, exposureGain, exposureGamma, rgbaQuantize, depthQuantize, quantizeGiven,
         displays, channels, depthFilter, opaqueThreshold, depthThreshold, imager, bucketWidth, bucketHeight, bucketOrder,
         maxRayDepth, gridSize, hider, jitter, relativeDetail, clippingPlanes, frame, searchPaths, user] = x;
  each(a, xResolution, yResolution, pixelAspect, frameAspect, screenWindow, cropWindow, projection, fov, nearClip, farClip,
       shutterOpen, shutterClose, shutterOffset, sampleMotion, fStop, focalLength, focalDistance, aperture, dofAspect, xSamples,
       ySamples, filter, xFilterWidth, yFilterWidth, exposureGain, exposureGamma, rgbaQuantize, depthQuantize, quantizeGiven,
       displays, channels, depthFilter, opaqueThreshold, depthThreshold, imager, bucketWidth, bucketHeight, bucketOrder,
       maxRayDepth, gridSize, hider, jitter, relativeDetail, clippingPlanes, frame, searchPaths, user);
}

template <class A>
void fields(A& a, DetailShare& x) {
  auto& [lo, hi] = x;
  each(a, lo, hi);
}

template <class A>
void fields(A& a, Visibility& x) {
  auto& [camera, diffuse, specular, transmission, photon] = x;
  each(a, camera, diffuse, specular, transmission, photon);
}

template <class A>
void fields(A& a, Attributes::Trace& x) {
  auto& [bias, offset, displacements, sampleMotion, maxDiffuseDepth, maxSpecularDepth, subset, tessellation, rate] = x;
  each(a, bias, offset, displacements, sampleMotion, maxDiffuseDepth, maxSpecularDepth, subset, tessellation, rate);
}

template <class A>
void fields(A& a, Attributes::Indirect& x) {
  auto& [receive, gain, bleeding, bleedingColor, surface] = x;
  each(a, receive, gain, bleeding, bleedingColor, surface);
}

template <class A>
void fields(A& a, Attributes::Photon& x) {
  auto& [globalMap, shadingModel] = x;
  each(a, globalMap, shadingModel);
}

template <class A>
void fields(A& a, Attributes& x) {
  auto& [color, opacity, textureCoordinates, shadingRate, motionFactor, focusFactor, interpolation, matte, sides, detail, insideOut,
         name, membership, diffuseHitMode, specularHitMode, transmissionHitMode, surface, displacement, atmosphere, interior, exterior, lights,
         areaLight, displacementBound, displacementBoundSpace, visibility, trace, indirect, photon, irradianceMaxError,
         irradianceMaxPixelDist, rasterOrient, binaryDice, user] = x;
  each(a, color, opacity, textureCoordinates, shadingRate, motionFactor, focusFactor, interpolation, matte, sides, detail, insideOut,
       name, membership, diffuseHitMode, specularHitMode, transmissionHitMode, surface, displacement, atmosphere, interior, exterior, lights,
       areaLight, displacementBound, displacementBoundSpace, visibility, trace, indirect, photon, irradianceMaxError,
       irradianceMaxPixelDist, rasterOrient, binaryDice, user);
}

template <class A>
void fields(A& a, Primvar& x) {
  auto& [name, storage, type, width, values] = x;
  each(a, name, storage, type, width, values);
}

template <class A>
void fields(A& a, ShadeGroup& x) {
  auto& [attributes, cameraFromObject, primvars, exampleObject, currentFromOpen, solid, subtracted, steps] = x;
  each(a, attributes, cameraFromObject, primvars, exampleObject, currentFromOpen, solid, subtracted, steps);
}

/// Packs what `withoutGeometry` leaves; its private members serve geometry alone, so that no structured binding guards this list.
template <class A>
void fields(A& a, Scene& x) {
  each(a, x.options, x.cameraFromWorld, x.lights, x.worldFromNamed, x.where, x.groups);
  std::vector<SourceLoc> places;
  for (const Object& o : x.objects) places.push_back(o.where);
  field(a, places);
  if constexpr (kUnpacks<A>) {
    for (size_t i = 0; i < std::min(x.groups.size(), places.size()); ++i) {
      Object o;
      o.attributes = x.groups[i].attributes, o.where = places[i], o.group = static_cast<int>(i);
      x.objects.push_back(std::move(o));
    }
  }
}

template <class A>
void fields(A& a, SourceFile& x) {
  auto& [path, sum] = x;
  each(a, path, sum);
}

/// A layout alone: tiles are records of their own.
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

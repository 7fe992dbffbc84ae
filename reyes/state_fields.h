// The fields of the structures of reyes/state.h, for reyes/base/pack.h. A structure that gains a field stops the
// compiler here: add it to the list, and files and checksums include it.
#pragma once
#include "reyes/base/pack.h"
#include "reyes/state.h"

namespace tomales {

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
  auto& [xResolution, yResolution, pixelAspect, frameAspect, screenWindow, cropWindow, projection, fov, nearClip,
         farClip, shutterOpen, shutterClose, shutterOffset, sampleMotion, fStop, focalLength, focalDistance, aperture,
         dofAspect, xSamples, ySamples, filter, xFilterWidth, yFilterWidth, exposureGain, exposureGamma, rgbaQuantize,
         depthQuantize, quantizeGiven, displays, channels, depthFilter, opaqueThreshold, depthThreshold, imager,
         bucketWidth, bucketHeight, bucketOrder, maxRayDepth, gridSize, hider, jitter, relativeDetail, clippingPlanes,
         wantsIndirect, indirectSamples, frame, searchPaths, user] = x;
  each(a, xResolution, yResolution, pixelAspect, frameAspect, screenWindow, cropWindow, projection, fov, nearClip,
       farClip, shutterOpen, shutterClose, shutterOffset, sampleMotion, fStop, focalLength, focalDistance, aperture,
       dofAspect, xSamples, ySamples, filter, xFilterWidth, yFilterWidth, exposureGain, exposureGamma, rgbaQuantize,
       depthQuantize, quantizeGiven, displays, channels, depthFilter, opaqueThreshold, depthThreshold, imager,
       bucketWidth, bucketHeight, bucketOrder, maxRayDepth, gridSize, hider, jitter, relativeDetail, clippingPlanes,
       wantsIndirect, indirectSamples, frame, searchPaths, user);
}

template <class A>
void fields(A& a, LightList::Run& x) {
  auto& [first, end] = x;
  each(a, first, end);
}

template <class A>
void fields(A& a, LightList& x) {
  auto& [runs] = x;
  each(a, runs);
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
  auto& [bias, offset, displacements, displacementsGiven, chosenFiner, sampleMotion, maxDiffuseDepth, maxSpecularDepth,
         subset, tessellation, rate] = x;
  each(a, bias, offset, displacements, displacementsGiven, chosenFiner, sampleMotion, maxDiffuseDepth, maxSpecularDepth,
       subset, tessellation, rate);
}

template <class A>
void fields(A& a, Attributes::Indirect& x) {
  auto& [receive, gain, bleeding, bleedingColor, surface] = x;
  each(a, receive, gain, bleeding, bleedingColor, surface);
}

template <class A>
void fields(A& a, Attributes::Photon& x) {
  auto& [globalMap, causticMap, shadingModel] = x;
  each(a, globalMap, causticMap, shadingModel);
}

template <class A>
void fields(A& a, Attributes::Radiosity& x) {
  auto& [screen, texelSize] = x;
  each(a, screen, texelSize);
}

template <class A>
void fields(A& a, Attributes::Cull& x) {
  auto& [hidden, backfacing] = x;
  each(a, hidden, backfacing);
}

template <class A>
void fields(A& a, Attributes& x) {
  auto& [color, opacity, textureCoordinates, shadingRate, motionFactor, focusFactor, interpolation, matte, volume,
         sides, detail, insideOut, name, membership, diffuseHitMode, specularHitMode, transmissionHitMode, surface,
         displacement, atmosphere, interior, exterior, lights, areaLight, displacementBound, displacementBoundSpace,
         displacementOutputs, visibility, trace, indirect, photon, radiosity, irradianceMaxError,
         irradianceMaxPixelDist, rasterOrient, cull, binaryDice, user] = x;
  each(a, color, opacity, textureCoordinates, shadingRate, motionFactor, focusFactor, interpolation, matte, volume,
       sides, detail, insideOut, name, membership, diffuseHitMode, specularHitMode, transmissionHitMode, surface,
       displacement, atmosphere, interior, exterior, lights, areaLight, displacementBound, displacementBoundSpace,
       displacementOutputs, visibility, trace, indirect, photon, radiosity, irradianceMaxError, irradianceMaxPixelDist,
       rasterOrient, cull, binaryDice, user);
}

}  // namespace tomales

#include "reyes/bindings/assimp/texture_coordinates.h"

#include <cmath>

namespace tomales::model {
namespace {

mat3 moving(float x, float y) { return {{1, 0, 0}, {0, 1, 0}, {x, y, 1}}; }
mat3 scaling(float x, float y) { return {{x, 0, 0}, {0, y, 0}, {0, 0, 1}}; }
mat3 turning(float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
}

/// KHR_texture_transform is offset * rotation * scale of coordinates whose v runs down, so its rotation has the
/// opposite sense of our matrix. Assimp keeps scale and rotation, but converts the offset to a rotation about the
/// middle of a picture whose v runs up (SetMaterialTextureProperty in its glTF2Importer.cpp). This function solves for
/// the extension's offset.
mat3 ofGltf(const aiUVTransform& t) {
  const float x = t.mScaling.x, y = t.mScaling.y, c = std::cos(t.mRotation), s = -std::sin(t.mRotation);
  const mat3 offset = moving(t.mTranslation.x - x * (1 - c + s) / 2, y * (s + c - 1) / 2 + 1 - y - t.mTranslation.y);
  return offset * turning(t.mRotation) * scaling(x, y) * kStFromUv;
}

/// Does the work of Assimp's own step (TextureTransform.cpp), which merges similar transformations, and limits offsets
/// of pictures that do not repeat to 1.
mat3 ofOthers(const aiUVTransform& t) {
  return kStFromUv * moving(0.5f, 0.5f) * scaling(t.mScaling.x, t.mScaling.y) * turning(t.mRotation) *
         moving(t.mTranslation.x - 0.5f, t.mTranslation.y - 0.5f);
}

}  // namespace

TextureCoordinates coordinatesOf(const aiMaterial& material, aiTextureType type, unsigned set, bool isGltf) {
  aiUVTransform transform;
  if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) != aiReturn_SUCCESS) return {set};
  return {set, isGltf ? ofGltf(transform) : ofOthers(transform)};
}

}  // namespace tomales::model

// Noun: everything that one WorldBegin/WorldEnd describes, frozen. Owns the geometry.
// Threads: immutable once freeze() has run.
#pragma once
#include <map>

#include "reyes/camera.h"
#include "reyes/prim.h"
#include "reyes/solid.h"

namespace tomales {

/// One primitive request placed in the world. Deforming geometry has a Prim for each of `shapeTimes`, alike in
/// topology; all motion in between is linear.
struct Object {
  std::vector<PrimPtr> shapes;
  std::vector<float> shapeTimes{0.0f};
  Motion worldFromObject;
  std::shared_ptr<const Attributes> attributes;
  SourceLoc where;
  int solid = -1;                ///< In Scene::solids: part of the surface of
  int solidBlock = -1;           ///< this primitive of it.

  // Filled by Scene::freeze().
  Motion cameraFromObject;       ///< Over the shutter; one key when nothing moves.
  Motion currentFromObject;      ///< The same with the camera held where it is at shutter open: the motion that rays see.
  std::vector<float> keyTimes;   ///< Union of transformation and deformation keys inside the shutter; front() is its opening.
  float displacementBound = 0;   ///< Camera space.
  bool flipsNormal = false;      ///< cameraFromObject mirrors, or Orientation is inside (not both).
  bool subtracted = false;       ///< Its solid lies on the side of its normals, which are turned for shading.
  int group = -1;                ///< Its ShadeGroup.

  const Prim& shape() const { return *shapes.front(); }
};

/// Objects whose points may be shaded together: the same attributes, transformation, motion and primvar names, and alike in or
/// outside of solids.
struct ShadeGroup {
  std::shared_ptr<const Attributes> attributes;
  mat4 cameraFromObject{1.0f};
  std::vector<Primvar> primvars;  ///< Layout only: name, storage, type, width; no values.
  int exampleObject = -1;         ///< Some object of the group, for messages.
  Motion currentFromOpen{};       ///< Takes places of the group at shutter open to where they are at a time, the camera held still.
  bool solid = false;             ///< Parts of solids.
  bool subtracted = false;        ///< As Object::subtracted.
};

struct Scene {
  Options options;
  Motion cameraFromWorld;
  std::vector<Object> objects;
  std::vector<Solid> solids;
  std::vector<std::shared_ptr<LightCall>> lights;
  std::map<std::string, mat4> worldFromNamed;  ///< CoordinateSystem
  SourceLoc where;                             ///< Of WorldBegin.

  std::vector<ShadeGroup> groups;              ///< Filled by freeze().
  /// Fills the derived fields above. Call when all objects and lights are in, and again after changing attributes.
  void freeze();

  bool shutterIsOpen() const { return options.shutterClose > options.shutterOpen; }  ///< Else nothing is blurred.
  mat4 cameraFromWorldAtOpen() const { return cameraFromWorld.at(options.shutterOpen); }
  /// "current" from a named space (camera, current, world, or a CoordinateSystem). False: unknown.
  bool cameraFromNamed(const std::string& name, mat4& out) const;
};

/// cameraFromObject at one time, and the shape to evaluate at a key time: linear between shapes is left to the grid.
std::string objectName(const Object& object);  ///< identifier name, or "object at FILE:LINE"

}  // namespace tomales

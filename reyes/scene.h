// Noun: everything that one WorldBegin/WorldEnd describes, frozen. It owns the geometry.
// Threads: once freeze() has run, it changes by add() and drop() alone, which one thread may call while others use the
// objects and groups that they know.
#pragma once
#include <functional>
#include <map>
#include <unordered_map>

#include "reyes/base/stable_vector.h"
#include "reyes/camera.h"
#include "reyes/prim.h"
#include "reyes/solid.h"

namespace tomales {

/// Returns how far the hider may push the border of a grid out in raster space, over its neighbour
/// (docs/decisions/0003).
constexpr float borderReach_px(float displacementBound) { return displacementBound > 0 ? 4.0f : 0.5f; }

/// The shapes of an object around a time. The shape then is `before` if `after` is null. Otherwise it lies between
/// them: `t` is 0 at `before` and 1 at `after`.
struct ShapesAround {
  const Prim *before, *after;
  float t;
};

/// One primitive request placed in the world. Deforming geometry has a Prim for each of `shapeTimes`, alike in
/// topology; all motion in between is linear.
struct Object {
  std::vector<PrimPtr> shapes;
  std::vector<float> shapeTimes{0.0f};
  Motion worldFromObject;
  std::shared_ptr<const Attributes> attributes;
  SourceLoc where;
  int solid = -1;       ///< Index in Scene::solids of the solid that it is a part of; -1 if there is none.
  int solidBlock = -1;  ///< Primitive block of that solid.
  /// In a primitive block: its normals point to the other side of the surface than those of the block's first object.
  bool turnedInSolid = false;
  uint64_t contents = 0;  ///< Checksum of the request that describes its shapes, wherever it is written.

  // Filled by Scene::freeze().
  Motion cameraFromObject;   ///< Over the shutter; one key when nothing moves.
  Motion currentFromObject;  ///< The same with the camera held at its place of shutter open: the motion that rays see.
  /// Union of transformation and deformation keys inside the shutter; front() is its opening.
  std::vector<float> keyTimes;
  float displacementBound = 0;  ///< Radius in camera space.
  bool flipsNormal = false;     ///< True if either cameraFromObject mirrors or Orientation is inside, but not both.
  bool subtracted = false;      ///< Its solid lies on the side of its normals, which are turned for shading.
  int group = -1;               ///< Index of its ShadeGroup.
  /// Key of its random numbers (SampleName): the same for any order in which procedurals are expanded.
  uint32_t sampleKey = 0;

  const Prim& shape() const { return *shapes.front(); }
  /// Returns the shapes around a time. Before the first of `shapeTimes` and after the last, the shape does not change.
  ShapesAround shapesAround(float time) const {
    size_t k = 0;
    while (k + 1 < shapes.size() && shapeTimes[k + 1] <= time) ++k;
    const bool between = k + 1 < shapes.size() && time > shapeTimes[k];
    return {shapes[k].get(), between ? shapes[k + 1].get() : nullptr,
            between ? (time - shapeTimes[k]) / (shapeTimes[k + 1] - shapeTimes[k]) : 0.0f};
  }
};

/// Objects whose points may be shaded together: they have the same attributes, transformation, motion and primvar
/// names, and are all parts of solids or none is.
struct ShadeGroup {
  std::shared_ptr<const Attributes> attributes;
  mat4 cameraFromObject{1.0f};
  std::vector<Primvar> primvars;  ///< Layout only: name, storage, type, width; no values.
  int exampleObject = -1;         ///< Some object of the group; -1 if that one was dropped.
  SourceLoc where{};              ///< Place of its first object, for messages.
  /// Transforms positions of the group at shutter open to those at a time, with the camera fixed.
  Motion currentFromOpen{};
  bool solid = false;       ///< The objects are parts of solids.
  bool subtracted = false;  ///< The same as Object::subtracted.
  bool steps = false;       ///< Its points have steps (reyes/points.h); set by code that knows the shaders.
};

struct Expansion;

/// Geometry that is described when it is needed (RISpec 3.2 section 5.10).
struct Procedural {
  Bound3 bound;  ///< Bound in object space.
  Motion worldFromObject;
  std::shared_ptr<const Attributes> attributes;
  SourceLoc where;
  /// Describes the geometry, anew with each call. May be called from several threads.
  std::function<Expansion()> expand;

  // Filled by Scene::freeze().
  Motion cameraFromObject;
  std::vector<float> keyTimes;
  float displacementBound = 0;
  uint32_t sampleKey = 0;  ///< The same as Object::sampleKey.
};

/// The contents of a procedural, which may have further procedurals.
struct Expansion {
  std::vector<Object> objects;
  std::vector<Procedural> procedurals;
  std::vector<Solid> solids{};  ///< Object::solid is an index in this list.
};

struct Scene {
  Options options;
  Motion cameraFromWorld;
  StableVector<Object> objects;
  StableVector<Solid> solids;
  std::vector<Procedural> procedurals;  ///< Not expanded yet.
  std::vector<std::shared_ptr<LightCall>> lights;
  std::map<std::string, mat4> worldFromNamed;  ///< Spaces of CoordinateSystem requests.
  /// Unit squares through which the program has found that a sky is seen (docs/decisions/0185).
  std::vector<mat4> worldFromOpenings;
  SourceLoc where;  ///< Location of WorldBegin.

  StableVector<ShadeGroup> groups;  ///< Filled by freeze() and add().
  /// Fills the derived fields above. Call it when all objects and lights are added, and again after changing
  /// attributes.
  void freeze();

  /// Expands a procedural. The result has its derived fields except for its groups. The scene does not change.
  Expansion expanded(const Procedural& procedural) const;
  /// Adds the objects of expanded(), and their solids, and finds their groups. Returns their indices.
  /// ShadingSystem::bindNewGroups has to be called next.
  std::vector<int> add(Expansion& expansion);
  /// Drops the shapes of an object that add() has added and that is not needed any more.
  void drop(int object);
  /// Expands all procedurals that are `wanted`, nested ones included. Call it before any object is used.
  void expandAll(const std::function<bool(const Attributes&)>& wanted);

  /// Returns a scene that has only the options, spaces, openings, lights and location of this one.
  Scene withoutObjects() const;

  mat4 cameraFromWorldAtOpen() const { return cameraFromWorld.at(options.shutterOpen); }
  /// Finds the transformation from a named space (camera, current, world, or a CoordinateSystem) to "current". Returns
  /// false if the name is unknown.
  bool cameraFromNamed(const std::string& name, mat4& out) const;

 private:
  void derive(Object& object) const;
  void derive(Procedural& procedural) const;
  int add(Object object);
  void findGroup(Object& object, int index);
  ShadeGroup groupFor(const Object& object, int index) const;
  float displacementBoundOf(const Attributes& attributes, const Motion& cameraFromObject, float time) const;

  /// The groups by a hash of all that their objects have in common. Requests share one Attributes until something
  /// changes, so attributes are compared by pointer.
  std::unordered_multimap<uint64_t, int> groupsByHash_;
  std::vector<int> dropped_;  ///< Indices that may be used again.
};

/// Returns false if the scene was read from a .dfb, which leaves shapes out.
inline bool hasGeometry(const Scene& scene) { return scene.objects.empty() || !scene.objects.front().shapes.empty(); }

std::string objectName(const Object& object);     ///< Its identifier name, or "object at FILE:LINE".
std::string objectName(const ShadeGroup& group);  ///< The same of its first object.

}  // namespace tomales

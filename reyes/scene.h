// Noun: everything that one WorldBegin/WorldEnd describes, frozen. Owns the geometry.
// Threads: once freeze() has run, it changes by add() and drop() alone, which one thread may call while others use the
// objects and groups that they know of.
#pragma once
#include <functional>
#include <map>
#include <unordered_map>

#include "reyes/base/stable_vector.h"
#include "reyes/camera.h"
#include "reyes/prim.h"
#include "reyes/solid.h"

namespace tomales {

/// How far the hider may push the border of a grid out in raster space, over its neighbour (docs/decisions/0003).
constexpr float borderReach_px(float displacementBound) { return displacementBound > 0 ? 4.0f : 0.5f; }

/// One primitive request placed in the world. Deforming geometry has a Prim for each of `shapeTimes`, alike in
/// topology; all motion in between is linear.
struct Object {
  std::vector<PrimPtr> shapes;
  std::vector<float> shapeTimes{0.0f};
  Motion worldFromObject;
  std::shared_ptr<const Attributes> attributes;
  SourceLoc where;
  int solid = -1;         ///< In Scene::solids: part of the surface of
  int solidBlock = -1;    ///< this primitive of it.
  uint64_t contents = 0;  ///< Sum of what describes its shapes, whatever file that stands in.

  // Filled by Scene::freeze().
  Motion cameraFromObject;   ///< Over the shutter; one key when nothing moves.
  Motion currentFromObject;  ///< The same with the camera held where it is at shutter open: the motion that rays see.
  std::vector<float>
      keyTimes;  ///< Union of transformation and deformation keys inside the shutter; front() is its opening.
  float displacementBound = 0;  ///< Camera space.
  bool flipsNormal = false;     ///< cameraFromObject mirrors, or Orientation is inside (not both).
  bool subtracted = false;      ///< Its solid lies on the side of its normals, which are turned for shading.
  int group = -1;               ///< Its ShadeGroup.
  uint32_t name = 0;            ///< For random numbers: the same for any order in which procedurals are opened.

  const Prim& shape() const { return *shapes.front(); }
};

/// Objects whose points may be shaded together: the same attributes, transformation, motion and primvar names, and
/// alike in or outside of solids.
struct ShadeGroup {
  std::shared_ptr<const Attributes> attributes;
  mat4 cameraFromObject{1.0f};
  std::vector<Primvar> primvars;  ///< Layout only: name, storage, type, width; no values.
  int exampleObject = -1;         ///< Some object of the group, for messages.
  Motion currentFromOpen{};  ///< Takes places of the group at shutter open to where they are at a time, the camera held
                             ///< still.
  bool solid = false;        ///< Parts of solids.
  bool subtracted = false;   ///< As Object::subtracted.
  bool steps = false;        ///< Its points have steps (reyes/points.h): set by whoever knows the shaders.
};

struct Expansion;

/// Geometry that is described when somebody needs it (RISpec 3.2 section 5.10).
struct Procedural {
  Bound3 bound;  ///< Object space.
  Motion worldFromObject;
  std::shared_ptr<const Attributes> attributes;
  SourceLoc where;
  /// Describes it, anew with each call. May be called from several threads.
  std::function<Expansion()> open;

  // Filled by Scene::freeze().
  Motion cameraFromObject;
  std::vector<float> keyTimes;
  float displacementBound = 0;
  uint32_t name = 0;
};

/// What a procedural stands for: more of them, perhaps.
struct Expansion {
  std::vector<Object> objects;
  std::vector<Procedural> procedurals;
  std::vector<Solid> solids{};  ///< Those that Object::solid counts.
};

struct Scene {
  Options options;
  Motion cameraFromWorld;
  StableVector<Object> objects;
  StableVector<Solid> solids;
  std::vector<Procedural> procedurals;  ///< Not opened yet.
  std::vector<std::shared_ptr<LightCall>> lights;
  std::map<std::string, mat4> worldFromNamed;  ///< CoordinateSystem
  SourceLoc where;                             ///< Of WorldBegin.

  StableVector<ShadeGroup> groups;  ///< Filled by freeze() and add().
  /// Fills the derived fields above. Call when all objects and lights are in, and again after changing attributes.
  void freeze();

  bool shutterIsOpen() const { return options.shutterClose > options.shutterOpen; }  ///< Else nothing is blurred.
  /// Opens a procedural; what comes out has its derived fields but for its groups. Changes nothing here.
  Expansion opened(const Procedural& procedural) const;
  /// Takes the objects of opened(), and their solids, and finds their groups: their indices.
  /// ShadingSystem::bindNewGroups comes next.
  std::vector<int> add(Expansion& expansion);
  /// Forgets the shapes of an object of add() that nobody needs any more.
  void drop(int object);
  /// Replaces procedurals that are wanted by what they stand for, those within included. Before any object is used.
  void open(const std::function<bool(const Attributes&)>& wanted);

  mat4 cameraFromWorldAtOpen() const { return cameraFromWorld.at(options.shutterOpen); }
  /// "current" from a named space (camera, current, world, or a CoordinateSystem). False: unknown.
  bool cameraFromNamed(const std::string& name, mat4& out) const;

 private:
  void derive(Object& object) const;
  void derive(Procedural& procedural) const;
  int add(Object object);
  void findGroup(Object& object, int index);
  ShadeGroup groupFor(const Object& object, int index) const;
  float displacementBoundOf(const Attributes& attributes, const mat4& cameraFromObject) const;

  /// By a hash of all that objects of a group have in common. Requests share one Attributes until something
  /// changes, so equal pointers tell.
  std::unordered_multimap<uint64_t, int> groupsByHash_;
  std::vector<int> dropped_;  ///< Indices that may be used again.
};

/// False: read from a .dfb, which leaves shapes out.
inline bool hasGeometry(const Scene& scene) { return scene.objects.empty() || !scene.objects.front().shapes.empty(); }

std::string objectName(const Object& object);  ///< identifier name, or "object at FILE:LINE"

}  // namespace tomales

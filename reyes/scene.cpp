#include "reyes/scene.h"

#include "reyes/base/parallel.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/displacement_outputs.h"

namespace tomales {
namespace {

bool sameLayout(const std::vector<Primvar>& a, const std::vector<Primvar>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Primvar& x, const Primvar& y) {
    return x.name == y.name && x.type == y.type && x.width == y.width;
  });
}

bool sameGroup(const ShadeGroup& a, const ShadeGroup& b) {
  return a.attributes == b.attributes && a.solid == b.solid && a.subtracted == b.subtracted &&
         a.cameraFromObject == b.cameraFromObject && a.currentFromOpen == b.currentFromOpen &&
         sameLayout(a.primvars, b.primvars);
}

/// A hash of what sameGroup() compares, except for the types and widths of primitive variables.
class GroupHash {
 public:
  explicit GroupHash(const ShadeGroup& g) {
    add(std::hash<const void*>()(g.attributes.get()));
    add(uint64_t{g.solid});
    add(uint64_t{g.subtracted});
    add(g.cameraFromObject);
    for (const float time : g.currentFromOpen.times) add(time);
    for (const mat4& key : g.currentFromOpen.keys) add(key);
    for (const Primvar& p : g.primvars) add(std::hash<std::string>()(p.name));
  }
  uint64_t value() const { return value_; }

 private:
  void add(uint64_t x) {
    value_ = (value_ ^ x) * 0x9e3779b97f4a7c15U;
    value_ ^= value_ >> 32;
  }
  void add(float x) { add(uint64_t{__builtin_bit_cast(uint32_t, x + 0.0f)}); }  // -0 equals 0
  void add(const mat4& m) {
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) add(m[column][row]);
  }

  uint64_t value_ = 0;
};

// Returns Object::keyTimes; only the opening of the shutter if nothing moves or the shutter is closed. `shapeTimes` is
// empty if the shape does not change.
std::vector<float> keyTimesOf(const std::vector<float>& shapeTimes, const Motion& cameraFromObject,
                              const Options& options) {
  std::vector<float> times{options.shutterOpen};
  if (options.shutterIsOpen() && (cameraFromObject.moving() || !shapeTimes.empty())) {
    const auto keep = [&](float t) {
      if (t > options.shutterOpen && t < options.shutterClose) times.push_back(t);
    };
    if (cameraFromObject.moving()) std::for_each(cameraFromObject.times.begin(), cameraFromObject.times.end(), keep);
    std::for_each(shapeTimes.begin(), shapeTimes.end(), keep);
    times.push_back(options.shutterClose);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
  }
  return times;
}

float largestScale(const mat4& m) {
  return std::max({glm::length(vec3(m[0])), glm::length(vec3(m[1])), glm::length(vec3(m[2]))});
}

// Returns the motion of an object as seen by a camera that stays where it is when the shutter opens. `m` is
// cameraFromObject at that time. The camera's own motion is not used, because that time may lie between two of its
// keys, and interpolation would add rounding: a still object must be exactly where the camera sees it.
Motion heldCamera(const Motion& worldFromObject, float open, const mat4& m) {
  if (!worldFromObject.moving()) return Motion::still(m);
  return Motion::still(m * glm::inverse(worldFromObject.at(open))) * worldFromObject;
}

// Turns shapes that face the eye, such as points and curves, to the place of the eye when the shutter opens.
void turnToEye(Object& o, const mat4& cameraFromObject, bool perspective) {
  const mat4 objectFromCamera = glm::inverse(cameraFromObject);
  const vec3 eye = transformPoint(objectFromCamera, vec3(0)),
             forward = transformVector(objectFromCamera, vec3(0, 0, 1));
  for (PrimPtr& shape : o.shapes)
    if (PrimPtr turned = shape->facing(eye, forward, perspective)) shape = std::move(turned);
}

}  // namespace

bool Scene::cameraFromNamed(const std::string& name, mat4& out) const {
  if (name == "camera" || name == "current") {
    out = mat4(1.0f);
    return true;
  }
  if (name == "world") {
    out = cameraFromWorldAtOpen();
    return true;
  }
  const auto it = worldFromNamed.find(name);
  if (it == worldFromNamed.end()) return false;
  out = cameraFromWorldAtOpen() * it->second;
  return true;
}

float Scene::displacementBoundOf(const Attributes& a, const Motion& cameraFromObject, float time) const {
  if (!a.displacement) return 0;
  if (a.displacementBoundSpace == "object") return a.displacementBound * largestScale(cameraFromObject.at(time));
  mat4 cameraFromBoundSpace = cameraFromObject.at(time);
  if (a.displacementBoundSpace == "shader")
    cameraFromBoundSpace = cameraFromWorldAtOpen() * a.displacement->worldFromShader.at(options.shutterOpen);
  else
    cameraFromNamed(a.displacementBoundSpace, cameraFromBoundSpace);
  // Shaders displace at shutter open, and displacement scales with the object.
  const mat4 fromOpen = cameraFromObject.at(time) * glm::inverse(cameraFromObject.at(options.shutterOpen));
  const float growth = time == options.shutterOpen ? 1 : largestScale(fromOpen);
  return a.displacementBound * largestScale(cameraFromBoundSpace) *
         (std::isfinite(growth) ? std::max(1.0f, growth) : 1);
}

void Scene::derive(Object& o) const {
  o.cameraFromObject = cameraFromWorld * o.worldFromObject;
  o.keyTimes = keyTimesOf(o.shapes.size() > 1 ? o.shapeTimes : std::vector<float>(), o.cameraFromObject, options);
  const mat4 m = o.cameraFromObject.at(options.shutterOpen);
  o.currentFromObject = heldCamera(o.worldFromObject, options.shutterOpen, m);
  turnToEye(o, m, options.projection == ProjectionKind::Perspective);
  o.flipsNormal = (glm::determinant(mat3(m)) < 0) != o.attributes->insideOut;
  o.displacementBound = 0;
  for (const float t : o.keyTimes)
    o.displacementBound = std::max(o.displacementBound, displacementBoundOf(*o.attributes, o.cameraFromObject, t));
}

void Scene::derive(Procedural& p) const {
  p.cameraFromObject = cameraFromWorld * p.worldFromObject;
  p.keyTimes = keyTimesOf({}, p.cameraFromObject, options);
  p.displacementBound = 0;
  for (const float t : p.keyTimes)
    p.displacementBound = std::max(p.displacementBound, displacementBoundOf(*p.attributes, p.cameraFromObject, t));
}

ShadeGroup Scene::groupFor(const Object& o, int index) const {
  const mat4 m = o.cameraFromObject.at(options.shutterOpen);
  ShadeGroup g{.attributes = o.attributes,
               .cameraFromObject = m,
               .primvars = {},
               .exampleObject = index,
               .where = o.where,
               .solid = o.solid >= 0,
               .subtracted = o.subtracted};
  if (o.currentFromObject.moving()) g.currentFromOpen = o.currentFromObject * Motion::still(glm::inverse(m));
  for (const Primvar& p : o.shape().primvars()) g.primvars.push_back({p.name, p.storage, p.type, p.width, {}});
  for (Primvar& p : displacementVariables(*o.attributes)) g.primvars.push_back(std::move(p));
  return g;
}

void Scene::findGroup(Object& o, int index) {
  o.subtracted = o.solid >= 0 && solids[static_cast<size_t>(o.solid)].subtracted(o.solidBlock);
  ShadeGroup group = groupFor(o, index);
  const uint64_t hash = GroupHash(group).value();
  const auto [begin, end] = groupsByHash_.equal_range(hash);
  const auto known = std::find_if(
      begin, end, [&](const auto& entry) { return sameGroup(groups[static_cast<size_t>(entry.second)], group); });
  if (known != end) {
    o.group = known->second;
    int& example = groups[static_cast<size_t>(o.group)].exampleObject;
    if (example < 0) example = index;
    return;
  }
  o.group = static_cast<int>(groups.size());
  groupsByHash_.emplace(hash, o.group);
  groups.push_back(std::move(group));
}

Scene Scene::withoutObjects() const {
  Scene out;
  out.options = options;
  out.cameraFromWorld = cameraFromWorld;
  out.lights = lights;
  out.worldFromNamed = worldFromNamed;
  out.worldFromOpenings = worldFromOpenings;
  out.where = where;
  return out;
}

void Scene::freeze() {
  groups.clear();
  groupsByHash_.clear();
  for (size_t i = 0; i < objects.size(); ++i) {
    derive(objects[i]);
    objects[i].sampleKey = static_cast<uint32_t>(i);
    findGroup(objects[i], static_cast<int>(i));
  }
  for (size_t i = 0; i < procedurals.size(); ++i) {
    derive(procedurals[i]);
    procedurals[i].sampleKey = hashCombine(randomStream("proc"), static_cast<uint32_t>(i));
  }
}

Expansion Scene::expanded(const Procedural& procedural) const {
  Expansion out = procedural.expand();
  uint32_t number = 0;
  for (Object& o : out.objects) {
    derive(o);
    o.sampleKey = hashCombine(procedural.sampleKey, number++);
  }
  for (Procedural& p : out.procedurals) {
    derive(p);
    p.sampleKey = hashCombine(procedural.sampleKey, number++);
  }
  return out;
}

std::vector<int> Scene::add(Expansion& expansion) {
  const int firstSolid = static_cast<int>(solids.size());
  for (Solid& s : expansion.solids) solids.push_back(std::move(s));
  std::vector<int> added;
  for (Object& o : expansion.objects) {
    if (o.solid >= 0) o.solid += firstSolid;
    added.push_back(add(std::move(o)));
  }
  return added;
}

int Scene::add(Object object) {
  int index = static_cast<int>(objects.size());
  if (!dropped_.empty()) {
    index = dropped_.back();
    dropped_.pop_back();
  }
  findGroup(object, index);
  if (index == static_cast<int>(objects.size()))
    objects.push_back(std::move(object));
  else
    objects[static_cast<size_t>(index)] = std::move(object);
  return index;
}

void Scene::drop(int object) {
  Object& o = objects[static_cast<size_t>(object)];
  Object rest;  // loops over all objects still find its attributes, and no shape
  rest.attributes = o.attributes;
  rest.where = o.where;
  rest.group = o.group;
  o = std::move(rest);
  if (int& example = groups[static_cast<size_t>(o.group)].exampleObject; example == object) example = -1;
  dropped_.push_back(object);
}

void Scene::expandAll(const std::function<bool(const Attributes&)>& wanted) {
  std::vector<Procedural> kept;
  while (!procedurals.empty()) {
    const auto rest = std::stable_partition(procedurals.begin(), procedurals.end(),
                                            [&](const Procedural& p) { return !wanted(*p.attributes); });
    std::vector<Procedural> now(std::make_move_iterator(rest), std::make_move_iterator(procedurals.end()));
    kept.insert(kept.end(), std::make_move_iterator(procedurals.begin()), std::make_move_iterator(rest));
    procedurals.clear();
    std::vector<Expansion> expansions(now.size());
    parallelFor(now.size(), 1, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) expansions[i] = expanded(now[i]);
    });
    for (Expansion& e : expansions) {
      add(e);
      procedurals.insert(procedurals.end(), std::make_move_iterator(e.procedurals.begin()),
                         std::make_move_iterator(e.procedurals.end()));
    }
  }
  procedurals = std::move(kept);
}

namespace {
std::string objectName(const Attributes& attributes, const SourceLoc& where) {
  return attributes.name.empty() ? "object at " + where.text() : "\"" + attributes.name + "\"";
}
}  // namespace

std::string objectName(const Object& object) { return objectName(*object.attributes, object.where); }
std::string objectName(const ShadeGroup& group) { return objectName(*group.attributes, group.where); }

}  // namespace tomales

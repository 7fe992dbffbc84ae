#include "reyes/scene.h"

#include <tuple>

namespace tomales {
namespace {

bool sameLayout(const std::vector<Primvar>& a, const std::vector<Primvar>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Primvar& x, const Primvar& y) {
    return x.name == y.name && x.type == y.type && x.width == y.width;
  });
}

// Key times inside the shutter, its opening first. Still, or a closed shutter: that one time.
std::vector<float> keyTimesOf(const Object& o, const Motion& cameraFromObject, const Options& options) {
  std::vector<float> times{options.shutterOpen};
  const bool open = options.sampleMotion && options.shutterClose > options.shutterOpen;
  if (open && (cameraFromObject.moving() || o.shapes.size() > 1)) {
    const auto keep = [&](float t) {
      if (t > options.shutterOpen && t < options.shutterClose) times.push_back(t);
    };
    if (cameraFromObject.moving()) std::for_each(cameraFromObject.times.begin(), cameraFromObject.times.end(), keep);
    if (o.shapes.size() > 1) std::for_each(o.shapeTimes.begin(), o.shapeTimes.end(), keep);
    times.push_back(options.shutterClose);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
  }
  return times;
}

float largestScale(const mat4& m) {
  return std::max({glm::length(vec3(m[0])), glm::length(vec3(m[1])), glm::length(vec3(m[2]))});
}

// Motion in the frame of the camera at shutter open, where `m` is the place of the object. Not the camera's own motion at that
// time, which may lie between two keys: what stands still must not be a rounding away from where the camera sees it.
Motion heldCamera(const Motion& worldFromObject, float open, const mat4& m) {
  if (!worldFromObject.moving()) return Motion::still(m);
  return Motion::still(m * glm::inverse(worldFromObject.at(open))) * worldFromObject;
}

// Points and curves turn to the eye as it stands when the shutter opens.
void turnToEye(Object& o, const mat4& cameraFromObject, bool perspective) {
  const mat4 objectFromCamera = glm::inverse(cameraFromObject);
  const vec3 eye = transformPoint(objectFromCamera, vec3(0)), forward = transformVector(objectFromCamera, vec3(0, 0, 1));
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

void Scene::freeze() {
  groups.clear();
  // Requests share one Attributes until something changes, so a look back at equal pointers finds the group fast.
  std::multimap<const Attributes*, int> byAttributes;
  for (size_t i = 0; i < objects.size(); ++i) {
    Object& o = objects[i];
    o.group = -1;
    o.cameraFromObject = cameraFromWorld * o.worldFromObject;
    o.keyTimes = keyTimesOf(o, o.cameraFromObject, options);
    const mat4 m = o.cameraFromObject.at(options.shutterOpen);
    o.currentFromObject = heldCamera(o.worldFromObject, options.shutterOpen, m);
    turnToEye(o, m, options.projection == ProjectionKind::Perspective);
    o.flipsNormal = (glm::determinant(mat3(m)) < 0) != o.attributes->insideOut;
    mat4 cameraFromBoundSpace = m;
    if (o.attributes->displacementBoundSpace != "object")
      cameraFromNamed(o.attributes->displacementBoundSpace, cameraFromBoundSpace);
    o.displacementBound = o.attributes->displacement ? o.attributes->displacementBound * largestScale(cameraFromBoundSpace) : 0;

    o.subtracted = o.solid >= 0 && solids[static_cast<size_t>(o.solid)].subtracted(o.solidBlock);

    const auto [begin, end] = byAttributes.equal_range(o.attributes.get());
    for (auto it = begin; it != end && o.group < 0; ++it) {
      const ShadeGroup& g = groups[static_cast<size_t>(it->second)];
      const Object& example = objects[static_cast<size_t>(g.exampleObject)];
      if (g.solid == (o.solid >= 0) && g.subtracted == o.subtracted && example.currentFromObject == o.currentFromObject &&
          sameLayout(g.primvars, o.shape().primvars()))
        o.group = it->second;
    }
    if (o.group < 0) {
      o.group = static_cast<int>(groups.size());
      byAttributes.emplace(o.attributes.get(), o.group);
      ShadeGroup g{o.attributes, m, {}, static_cast<int>(i)};
      g.solid = o.solid >= 0, g.subtracted = o.subtracted;
      if (o.currentFromObject.moving()) g.currentFromOpen = o.currentFromObject * Motion::still(glm::inverse(m));
      for (const Primvar& p : o.shape().primvars()) g.primvars.push_back({p.name, p.storage, p.type, p.width, {}});
      groups.push_back(std::move(g));
    }
  }
}

std::string objectName(const Object& object) {
  return object.attributes->name.empty() ? "object at " + object.where.text() : "\"" + object.attributes->name + "\"";
}

}  // namespace tomales

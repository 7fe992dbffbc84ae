// The parts of the scene builder that make Objects.
#include <fmt/format.h>

#include <utility>

#include "reyes/rib/collapsed.h"
#include "reyes/rib/contents.h"
#include "reyes/rib/geometry_builders.h"
#include "reyes/rib/object_attributes.h"
#include "reyes/rib/scene_builder.h"

namespace tomales::rib {
namespace {

// Squares of distances, and their products with areas, must fit floats.
constexpr float kFarthest = 1e12f;

/// Returns how far from the camera a point of the object may be that lies within `reach` of its own origin.
float farthest(const Motion& cameraFromObject, float reach) {
  float out = 0;
  for (const mat4& m : cameraFromObject.keys)
    out = std::max(out, glm::length(vec3(m[3])) +
                            reach * (glm::length(vec3(m[0])) + glm::length(vec3(m[1])) + glm::length(vec3(m[2]))));
  return out;
}

bool sameTopology(const Prim& a, const Prim& b) {
  const auto alike = [](const Primvar& x, const Primvar& y) {
    return x.name == y.name && x.storage == y.storage && x.values.size() == y.values.size();
  };
  return a.patchCount() == b.patchCount() &&
         std::equal(a.primvars().begin(), a.primvars().end(), b.primvars().begin(), b.primvars().end(), alike);
}

/// Tells whether the motion collapses everything to a point or a line all the time, so that nothing has an area.
bool vanishes(const Motion& m) {
  return std::all_of(m.keys.begin(), m.keys.end(), [](const mat4& k) {
    const glm::dmat3 a(k);
    return cross(a[0], a[1]) == glm::dvec3(0) && cross(a[1], a[2]) == glm::dvec3(0) &&
           cross(a[2], a[0]) == glm::dvec3(0);
  });
}

bool sameBasis(const Basis& a, const Basis& b) { return a.step == b.step && a.matrix == b.matrix; }

std::string descriptionOf(const GraphicsState& state, const Request& r) {
  const std::string& name = state.scope.attributes->name;
  return name.empty() ? r.name : r.name + " \"" + name + "\"";
}

/// Tells whether geometry is drawn here. If not, this is reported, unless a level of detail is the reason.
bool isDrawn(GraphicsState& state, const Request& r, const Motion& cameraFromObject) {
  if (!state.world) {
    state.warnOnce("outside", r, "rib-outside-world",
                   descriptionOf(state, r) + ": geometry outside of WorldBegin and WorldEnd is ignored");
    return false;
  }
  if (isFinite(cameraFromObject) && vanishes(cameraFromObject)) {
    state.warnOnce(
        "collapsed:" + descriptionOf(state, r), r, "rib-collapsed",
        descriptionOf(state, r) + ": its transformation collapses it to a point or a line; nothing of it is drawn");
    return false;
  }
  if (!isFinite(cameraFromObject) || !isInvertible(cameraFromObject)) {
    state.log.report(Severity::Missing, "rib-object-dropped", r.where,
                     descriptionOf(state, r) + ": its transformation is singular or not finite; the object is dropped");
    return false;
  }
  return !state.scope.attributes->detail.empty();
}

/// Does the same for a Volume, and warns if it should move.
bool isDrawnVolume(GraphicsState& state, const Request& r, bool changes) {
  if (state.isOpen(Block::Solid)) {
    state.log.report(Severity::Missing, "rib-object-dropped", r.where,
                     descriptionOf(state, r) + ": a Volume cannot be part of a solid; the object is dropped");
    return false;
  }
  if (changes || state.scope.ctm.moving())
    state.warnOnce("volume moves", r, "rib-motion",
                   descriptionOf(state, r) + ": a Volume does not move; it stands where it is when the shutter opens");
  return true;
}

void makeStill(Object& object, float time) {
  object.shapes.resize(1);
  object.shapeTimes.resize(1);
  object.worldFromObject = Motion::still(object.worldFromObject.at(time));
}

}  // namespace

void SceneBuilder::addGeometry(const Keys& keys, const std::vector<float>& times) {
  const Request& r = *keys[0];
  const Motion cameraFromObject = state_.cameraFromObject();
  const bool isVolume = r.name == "Volume";
  if (!isDrawn(state_, r, cameraFromObject) || (isVolume && !isDrawnVolume(state_, r, keys.size() > 1))) return;
  Master::Shapes shapes = shapesOf(keys, times);
  if (shapes.keys.empty()) return;
  if (const float reach = farthest(cameraFromObject, shapes.reach); !(reach < kFarthest)) {
    state_.log.report(
        Severity::Missing, "rib-object-dropped", r.where,
        fmt::format("{}: it may reach {:g} from the camera, and floats are no good beyond {:g}; the object is dropped",
                    description(r), reach, kFarthest));
    return;
  }
  Object object;
  object.shapes = std::move(shapes.keys);
  object.shapeTimes = std::move(shapes.times);
  object.worldFromObject = state_.scope.ctm;
  if (isVolume) makeStill(object, state_.globals.options.shutterOpen);
  state_.scope.attributes = state_.attributesInterner(state_.scope.attributes);
  object.attributes = state_.attributesInterner(attributesOf(r, state_));
  object.where = r.where;
  object.contents = shapes.contents;
  placeInSolid(state_, object);
  state_.world->objects.push_back(std::move(object));
}

Master::Shapes SceneBuilder::shapesOf(const Keys& keys, const std::vector<float>& times) {
  if (!master_ || hasGround(*keys.front())) return buildShapes(keys, times);
  const Scope& scope = state_.scope;
  const std::lock_guard lock(master_->mutex);
  const auto [it, fresh] = master_->shapes.try_emplace(masterRequest_);
  Master::Shapes& shared = it->second;
  if (fresh || !sameBasis(shared.uBasis, scope.uBasis) || !sameBasis(shared.vBasis, scope.vBasis) ||
      shared.roundCurves != scope.roundCurves || *shared.trim != *scope.trim)
    shared = buildShapes(keys, times);
  return shared;
}

Master::Shapes SceneBuilder::buildShapes(const Keys& keys, const std::vector<float>& times) {
  Master::Shapes out{{},
                     times,
                     state_.scope.uBasis,
                     state_.scope.vBasis,
                     state_.scope.roundCurves,
                     state_.scope.trim,
                     0,
                     contentsOf(keys, times, state_.scope)};
  for (const Request* key : keys) {
    out.reach = std::max(out.reach, reachOf(*key));
    PrimPtr prim = buildShape(*key, {keys, out.keys.empty() ? nullptr : out.keys[0].get()});
    if (!prim && out.keys.empty()) return out;
    if (!prim || (!out.keys.empty() && !sameTopology(*out.keys[0], *prim))) {
      state_.log.report(Severity::Warning, "rib-motion", key->where,
                        description(*key) + ": its shapes over time differ in topology; it keeps the first");
      out.keys.resize(1);
      break;
    }
    out.keys.push_back(std::move(prim));
  }
  out.times.resize(out.keys.size());
  return out;
}

PrimPtr SceneBuilder::buildShape(const Request& r, const MotionKeys& motion) {
  if (const char* what = emptyOf(r)) {
    state_.log.report(Severity::Warning, "rib-empty-mesh", r.where, description(r) + ": it has no " + what);
    return nullptr;
  }
  if (hasNoArea(r)) {
    state_.log.report(Severity::Warning, "rib-no-area", r.where, description(r) + ": it has no area");
    return nullptr;
  }
  Problems problems;
  PrimPtr prim;
  try {
    prim = buildPrim(
        r, state_.scope, motion, [&](int string) { return groundOf(r, string); }, problems);
  } catch (const PrimError& e) {
    state_.log.report(Severity::Missing, "rib-object-dropped", r.where,
                      fmt::format("{}: {}; the object is dropped", description(r), e.what()));
  }
  if (prim && prim->patchCount() == 0) {
    prim = nullptr;
    problems.push_back("nothing is left to draw");
  }
  if (!problems.empty())
    state_.log.report(Severity::Warning, "rib-primitive", r.where,
                      fmt::format("{}: {}", description(r), fmt::join(problems, "; ")));
  return prim;
}

/// Reads the ground where the object is when the shutter opens.
std::optional<GroundPicture> SceneBuilder::groundOf(const Request& r, int string) const {
  const std::vector<std::string>& names = r.args[3].strings;
  if (string < 0 || static_cast<size_t>(string) >= names.size())
    throw PrimError(fmt::format("a leaf names string {} of {}", string, names.size()));
  const std::string& name = names[static_cast<size_t>(string)];
  try {
    return readGround(name, state_.scope.ctm.at(state_.globals.options.shutterOpen));
  } catch (const PrimError& e) {
    state_.log.report(
        Severity::Missing, "rib-ground", r.where,
        fmt::format("{}: its ground \"{}\" cannot be read ({}); nothing repels it", description(r), name, e.what()));
    return {};
  }
}

std::string SceneBuilder::description(const Request& r) const { return descriptionOf(state_, r); }

}  // namespace tomales::rib

#include "reyes/scene_changes.h"

namespace tomales {
namespace {

/// The changed copy of each Attributes, which is made once.
class ChangedAttributes {
 public:
  explicit ChangedAttributes(std::function<void(Attributes&)> change) : change_(std::move(change)) {}

  void replace(std::shared_ptr<const Attributes>& attributes) {
    auto& [original, copy] = changed_[attributes.get()];
    if (!copy) {
      auto fresh = std::make_shared<Attributes>(*attributes);
      change_(*fresh);
      original = attributes;
      copy = std::move(fresh);
    }
    attributes = copy;
  }

  void replace(Procedural& p) {
    replace(p.attributes);
    p.expand = [change = change_, expand = std::move(p.expand)] {
      Expansion out = expand();
      ChangedAttributes changed(change);
      for (Object& o : out.objects) changed.replace(o.attributes);
      for (Procedural& inner : out.procedurals) changed.replace(inner);
      return out;
    };
  }

 private:
  std::function<void(Attributes&)> change_;
  /// The originals stay alive, so that no copy can take the address of one.
  std::map<const Attributes*, std::pair<std::shared_ptr<const Attributes>, std::shared_ptr<const Attributes>>> changed_;
};

}  // namespace

void changeAttributes(Scene& scene, const std::function<void(Attributes&)>& change) {
  ChangedAttributes changed(change);
  for (Object& o : scene.objects) changed.replace(o.attributes);
  for (ShadeGroup& g : scene.groups) changed.replace(g.attributes);
  for (Procedural& p : scene.procedurals) changed.replace(p);
  if (hasGeometry(scene)) scene.freeze();
}

bool leavesDisplacementOpen(const Attributes& a) {
  return a.displacement && !a.trace.displacements && !a.trace.displacementsGiven;
}

std::shared_ptr<const Attributes> withDisplacementForRays(const Attributes& a, float finer) {
  auto out = std::make_shared<Attributes>(a);
  out->trace.displacements = true;
  out->trace.tessellation *= finer;
  out->trace.chosenFiner = finer;
  return out;
}

std::shared_ptr<const Attributes> asTheSceneSays(const std::shared_ptr<const Attributes>& a) {
  if (a->trace.chosenFiner == 0) return a;
  auto out = std::make_shared<Attributes>(*a);
  out->trace.displacements = false;
  out->trace.tessellation /= out->trace.chosenFiner;
  out->trace.chosenFiner = 0;
  return out;
}

}  // namespace tomales

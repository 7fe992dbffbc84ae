#include "reyes/scene_changes.h"

namespace tomales {
namespace {

constexpr const char* kSaid = "trace:displacements";         ///< The reader of RIB keeps it.
constexpr const char* kChosen = "trace:chosentessellation";  ///< How many times finer polygons have become.

/// The changed copy of each Attributes, which is made once.
class ChangedAttributes {
 public:
  explicit ChangedAttributes(std::function<void(Attributes&)> change) : change_(std::move(change)) {}

  void replace(std::shared_ptr<const Attributes>& attributes) {
    auto& [original, copy] = changed_[attributes.get()];
    if (!copy) {
      auto fresh = std::make_shared<Attributes>(*attributes);
      change_(*fresh);
      original = attributes, copy = std::move(fresh);
    }
    attributes = copy;
  }

  void replace(Procedural& p) {
    replace(p.attributes);
    p.open = [change = change_, open = std::move(p.open)] {
      Expansion out = open();
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
  return a.displacement && !a.trace.displacements && !a.user.contains(kSaid);
}

std::shared_ptr<const Attributes> withDisplacementForRays(const Attributes& a, float finer) {
  auto out = std::make_shared<Attributes>(a);
  out->trace.displacements = true, out->trace.tessellation *= finer;
  Param p;
  p.name = kChosen, p.floats = {finer};
  out->user[kChosen] = p;
  return out;
}

std::shared_ptr<const Attributes> asTheSceneSays(const std::shared_ptr<const Attributes>& a) {
  const auto chosen = a->user.find(kChosen);
  if (chosen == a->user.end()) return a;
  auto out = std::make_shared<Attributes>(*a);
  out->trace.displacements = false, out->trace.tessellation /= chosen->second.number(1);
  out->user.erase(kChosen);
  return out;
}

}  // namespace tomales

#include "reyes/rib/graphics_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

namespace tomales::rib {

Attributes& Scope::edit() {
  if (attributes.use_count() > 1) attributes = std::make_shared<Attributes>(*attributes);
  return *attributes;
}

const char* blockName(Block block) {
  static constexpr const char* kNames[] = {"Frame", "World", "Attribute", "Transform", "Solid", "Instance"};
  return kNames[static_cast<int>(block)];
}

void GraphicsState::begin(Block block, const SourceLoc& where) {
  const bool saveGlobals = block == Block::Frame || block == Block::World;
  if (!saveGlobals && stack_.size() >= kDeepest) {
    ++tooDeep_;
    log.report(Severity::Warning, "rib-nesting", where,
               fmt::format("more than {} open blocks; {}Begin saves nothing", kDeepest, blockName(block)));
    return;
  }
  stack_.push_back({block, where, scope, saveGlobals ? std::make_unique<Globals>(globals) : nullptr});
  if (block == Block::Transform) return;
  scope.detail.range.reset();
  scope.detail.left = scope.attributes->detail;
}

bool GraphicsState::isOpen(Block block) const {
  return std::any_of(stack_.begin(), stack_.end(), [&](const Saved& s) { return s.block == block; });
}

bool GraphicsState::end(Block block, const SourceLoc& where) {
  const bool global = block == Block::Frame || block == Block::World;
  if (tooDeep_ > 0 && !global) {
    --tooDeep_;
    return true;
  }
  size_t at = stack_.size();
  const auto isWall = [](const Saved& s) { return s.globals || s.block == Block::Instance; };
  while (at > 0 && stack_[at - 1].block != block && (global || !isWall(stack_[at - 1]))) --at;
  if (at == 0 || stack_[at - 1].block != block) {
    log.report(Severity::Warning, "rib-unbalanced", where,
               fmt::format("{0}End without {0}Begin, ignored", blockName(block)));
    return false;
  }
  if (at < stack_.size())
    log.report(Severity::Warning, "rib-unbalanced", where,
               fmt::format("{}End closes {} open blocks, the innermost a {}Begin at {}", blockName(block),
                           stack_.size() - at, blockName(stack_.back().block), stack_.back().where.text()));
  if (global) tooDeep_ = 0;
  Saved& saved = stack_[at - 1];
  if (block == Block::Transform)
    scope.ctm = std::move(saved.scope.ctm);
  else
    scope = std::move(saved.scope);
  if (saved.globals) globals = std::move(*saved.globals);
  stack_.resize(at - 1);
  return true;
}

void GraphicsState::enterWorld(const SourceLoc& where) {
  Motion camera = scope.ctm;
  if (!isFinite(camera) || !isInvertible(camera)) {
    log.report(Severity::Warning, "rib-camera", where,
               "the camera transformation cannot be inverted; identity is used");
    camera = Motion();
  }
  const Motion worldFromCamera = inverse(camera);
  const auto move = [&](ShaderCall& call) { call.worldFromShader = worldFromCamera * call.worldFromShader; };
  const auto scopeMoved = [&](Scope& s) {
    Attributes& a = s.edit();
    for (std::shared_ptr<const ShaderCall>* call :
         {&a.surface, &a.displacement, &a.atmosphere, &a.interior, &a.exterior}) {
      if (!*call) continue;
      ShaderCall copy = **call;
      move(copy);
      *call = std::make_shared<const ShaderCall>(std::move(copy));
    }
    for (auto& [name, system] : s.coordinateSystems) system = worldFromCamera * system;
  };
  scopeMoved(scope);
  for (auto& saved : globals.resources)
    for (auto& [name, resource] : saved) {
      scopeMoved(resource);
      resource.ctm = worldFromCamera * resource.ctm;
    }
  for (auto& light : globals.lights) {
    light = std::make_shared<LightCall>(*light);
    move(light->shader);
  }
  if (globals.options.imager) move(*globals.options.imager);
  for (auto& [name, system] : globals.coordinateSystems) system = worldFromCamera * system;
  scope.ctm = Motion();
  identity = Motion();
  world = World{camera, {}, {}, {}, where};
}

void GraphicsState::switchOnEverywhere(int light) {
  const auto switchOn = [light](Scope& s) {
    if (!s.attributes->lights.contains(light)) s.edit().lights.switchOn(light);
  };
  switchOn(scope);
  for (Saved& saved : stack_) switchOn(saved.scope);
  if (world && (!world->objects.empty() || !world->procedurals.empty()))
    world->lateLights.push_back({light, world->objects.size(), world->procedurals.size()});
}

namespace {

/// Returns attributes with further lights.
std::shared_ptr<const Attributes> withLights(const std::shared_ptr<const Attributes>& attributes,
                                             const std::vector<int>& lights) {
  if (lights.empty()) return attributes;
  auto copy = std::make_shared<Attributes>(*attributes);
  for (const int light : lights) copy->lights.switchOn(light);
  return copy;
}

/// Returns the contents of a procedural with further lights.
Expansion withLights(Expansion contents, const std::vector<int>& lights) {
  std::map<const Attributes*, std::shared_ptr<const Attributes>> lit;
  const auto light = [&](std::shared_ptr<const Attributes>& attributes) {
    auto& known = lit[attributes.get()];
    if (!known) known = withLights(attributes, lights);
    attributes = known;
  };
  for (Object& o : contents.objects) light(o.attributes);
  for (Procedural& p : contents.procedurals) {
    light(p.attributes);
    p.expand = [expand = std::move(p.expand), lights] { return withLights(expand(), lights); };
  }
  return contents;
}

/// Returns the lights of `late` that these attributes lack.
std::vector<int> lacking(const Attributes& attributes, std::span<const World::LateLight> late) {
  std::vector<int> out;
  for (const World::LateLight& l : late)
    if (!attributes.lights.contains(l.light)) out.push_back(l.light);
  return out;
}

}  // namespace

// Objects share attributes, so objects that lack the same lights get one changed copy. The contents of a procedural
// have their own copies of attributes, and get the lights when the procedural is opened.
void GraphicsState::lightEarlierObjects() {
  const std::span<const World::LateLight> late = world->lateLights;
  // Returns the late lights that come after the object or procedural of this index.
  const auto after = [late](size_t number, size_t World::LateLight::*before) {
    return std::span(std::ranges::upper_bound(late, number, {}, before), late.end());
  };
  std::map<std::pair<const Attributes*, size_t>, std::shared_ptr<const Attributes>> lit;
  for (size_t i = 0; i < world->objects.size(); ++i) {
    const auto lights = after(i, &World::LateLight::objects);
    if (lights.empty()) break;
    std::shared_ptr<const Attributes>& own = world->objects[i].attributes;
    auto& known = lit[{own.get(), lights.size()}];
    if (!known) known = withLights(own, lacking(*own, lights));
    own = known;
  }
  for (size_t i = 0; i < world->procedurals.size(); ++i) {
    const auto later = after(i, &World::LateLight::procedurals);
    if (later.empty()) break;
    Procedural& p = world->procedurals[i];
    const std::vector<int> lights = lacking(*p.attributes, later);
    p.attributes = withLights(p.attributes, lights);
    p.expand = [expand = std::move(p.expand), lights] { return withLights(expand(), lights); };
  }
}

void GraphicsState::warn(const Request& request, const char* code, const std::string& message) const {
  log.report(Severity::Warning, code, request.where, request.name + ": " + message);
}

void GraphicsState::warnOnce(const std::string& key, const SourceLoc& where, const char* code,
                             const std::string& message, Severity severity) {
  log.report(severity, code, where, message, key);
}

bool isFinite(const Motion& m) {
  return std::all_of(m.keys.begin(), m.keys.end(), [](const mat4& k) {
    return std::all_of(&k[0][0], &k[0][0] + 16, [](float f) { return std::isfinite(f); });
  });
}

// It computes in double precision, so that the determinant neither overflows for a landscape in millimetres nor
// underflows for a scene that is scaled far down.
bool isInvertible(const Motion& m) {
  return std::all_of(m.keys.begin(), m.keys.end(), [](const mat4& k) {
    const double d = glm::determinant(glm::dmat4(k));
    return std::isfinite(d) && d != 0;
  });
}

Motion inverse(const Motion& m) {
  Motion out{m.times, {}};
  for (const mat4& k : m.keys) out.keys.push_back(mat4(glm::inverse(glm::dmat4(k))));
  return out;
}

}  // namespace tomales::rib

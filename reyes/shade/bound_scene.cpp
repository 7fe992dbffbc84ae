#include "reyes/shade/bound_scene.h"

#include <fmt/format.h>

#include "reyes/displacement_outputs.h"
#include "reyes/rsl_host.h"
#include "reyes/shade/binder.h"
#include "reyes/shade/parameter_values.h"
#include "reyes/shader/params.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

/// Reports, once for each shader, the parameters that primitive variables of their name cannot override.
std::vector<Override> overridesOf(const BoundShader& bound, const std::vector<Primvar>& primvars, Log& log) {
  std::vector<Override> out;
  for (int i = 0; i < bound.shader->paramCount; ++i) {
    const TmParamDecl& decl = bound.shader->params[i];
    if (isOutput(decl)) continue;
    const int length = std::max(1, decl.arrayLength), width = length * floatsOf(typeOf(decl));
    const bool overridable =
        (typeOf(decl) <= TM_NORMAL && length == 1) || (typeOf(decl) != TM_STRING && (decl.type & kArrayVaries) != 0);
    int offset = 0;
    for (const Primvar& p : primvars) {
      const bool same = overridable && p.name == decl.name && p.width == width;
      if (same && isUniform(decl))
        log.report(Severity::Warning, "shader-parameter-uniform", bound.where,
                   fmt::format(
                       "{}: shader \"{}\": parameter \"{}\" is uniform; the primitive variable of that name is ignored",
                       bound.user, bound.shader->name, decl.name),
                   fmt::format("{} {}", bound.shader->name, decl.name));
      else if (same)
        out.push_back({i, offset, width});
      else if (p.name == decl.name)
        log.report(Severity::Warning, "shader-parameter-type", bound.where,
                   fmt::format("{}: shader \"{}\": parameter \"{}\" is of another type or length than the primitive "
                               "variable of that name, which is ignored",
                               bound.user, bound.shader->name, decl.name),
                   fmt::format("{} {}", bound.shader->name, decl.name));
      offset += p.width;
    }
  }
  return out;
}

void findPrimvars(BoundGroup& g) {
  for (const Primvar& p : g.group->primvars) {
    if (p.name.starts_with(kOfDisplacement) && g.displacement)
      if (const int output = g.displacement->output(p.name.substr(kOfDisplacement.size()), p.type); output >= 0)
        g.displacementOutputs.push_back({output, g.primvarFloats, p.width});
    if (p.name == "Cs" && p.width == 3) g.CsOffset = g.primvarFloats;
    if (p.name == "Os" && p.width == 3) g.OsOffset = g.primvarFloats;
    if (p.name == "s" && p.width == 1) g.sOffset = g.primvarFloats;
    if (p.name == "t" && p.width == 1) g.tOffset = g.primvarFloats;
    g.primvarFloats += p.width;
  }
}

/// Makes the surface store the outputs that the atmosphere, which runs after it, may ask for, because its text names
/// them.
void tellAir(BoundGroup& g) {
  if (!g.atmosphere) return;
  int next = 0;
  for (const BoundVariable& v : g.variables) next = std::max(next, v.first + v.width);
  for (const std::string& name : rslTexts(*g.atmosphere->shader)) {
    const int index = g.surface->outputNamed(name);
    if (index < 0) continue;
    const auto same = [&](const BoundVariable& v) { return v.from == VariableSource::Output && v.index == index; };
    auto kept = std::find_if(g.variables.begin(), g.variables.end(), same);
    if (kept == g.variables.end()) {
      BoundVariable v;
      v.from = VariableSource::Output;
      v.index = index;
      v.first = next;
      v.width = floatsOf(typeOf(g.surface->shader->params[index]));
      next += v.width;
      kept = g.variables.insert(g.variables.end(), std::move(v));
    }
    g.toldToAir.push_back({index, kept->first, kept->width});
  }
}

void warnAboutUnwritten(const FrameOutput& output, const BoundScene& scene) {
  for (size_t i = 0; i < output.variables.size(); ++i) {
    const Variable& v = output.variables[i];
    const auto writes = [&](const BoundGroup& g) { return g.variables[i].from != VariableSource::Nothing; };
    if (std::any_of(scene.groups.begin(), scene.groups.end(), writes)) continue;
    scene.log.report(Severity::Warning, "channel-unwritten", v.where,
                     fmt::format("no shader and no surface of this frame has an output \"{}\"; the channel holds {}",
                                 v.source, v.fill));
  }
}

/// docs/decisions/0004.
float specularSharpnessOf(const Scene& scene, Log& log) {
  const std::string convention = wordOf(scene.options.user, "shade:specular");
  if (!convention.empty() && convention != "prman" && convention != "rispec")
    log.report(Severity::Warning, "option-specular", {},
               "Option \"shade\" \"specular\" \"" + convention + "\" is neither \"prman\" nor \"rispec\"; ignored");
  return convention == "rispec" ? 1.0f : 8.0f;
}

int lightCutOf(const Options& options) {
  const Param* cut = findParam(options.user, "trace:lightcut");
  if (!cut) return kLightCut;
  return static_cast<int>(std::fmin(std::fmax(cut->number(0), 0.0f), float{kMostLightSamples}));  // 0 for NaN
}

/// Option "limits" "texturememory" is in KB.
int64_t textureMemoryOf(const Options& options) {
  const Param* limit = findParam(options.user, "limits:texturememory");
  return limit ? static_cast<int64_t>(std::max(1.0f, limit->number(0))) << 10 : TextureSettings{}.memory_bytes;
}

/// Returns a light whose shader never runs.
BoundShaderPtr storedLight() {
  static const rsl::Shader shader(TM_LIGHT, "stored irradiance", "", 0, nullptr, {});
  auto bound = std::make_shared<BoundShader>();
  bound->shader = shader;
  return bound;
}

}  // namespace

BoundScene::BoundScene(const Scene& s, ShaderRegistry& registry, Log& l, Stats& st)
    : scene(s),
      log(l),
      stats(st),
      camera(s.options),
      cameraFromWorld(s.cameraFromWorldAtOpen()),
      lightCut(lightCutOf(s.options)),
      specularSharpness(specularSharpnessOf(s, l)),
      textures({pathOf(s.options.searchPaths, "texture"), pathOf(s.options.searchPaths, "texturecache"),
                textureMemoryOf(s.options)},
               l, st),
      shadowMaps(pathOf(s.options.searchPaths, "texture"), l),
      skies(textures, skyFromCurrent(cameraFromWorld)) {
  output_ = outputOf(scene.options);
  if (std::any_of(output_.variables.begin(), output_.variables.end(),
                  [](const Variable& v) { return v.source.starts_with(kLightGroup); }))
    lightCut = 0;
  binder_ = std::make_unique<Binder>(scene, registry, textures, shadowMaps, log);
  for (const auto& call : scene.lights) binder_->expect(&call->shader, TM_LIGHT);
  if (scene.options.imager) binder_->expect(&*scene.options.imager, TM_IMAGER);
  binder_->prepare();
  for (const auto& call : scene.lights) lights.push_back(binder_->light(*call, static_cast<int>(lights.size())));
  connectFilters(*this);
  if (scene.options.wantsIndirect) addIndirectLight();
  listLights();
  stored.bound = storedLight();
  pixels.group = &picture;
  pixels.object = "the picture";
  pixels.choice = std::make_shared<LightChoice>(LightList());
  imager = binder_->imager(scene.options.imager, pixels.object);
  shareChoices();
  bindNewGroups();
  grows_ = !scene.procedurals.empty();
  if (!grows_) warnAboutUnwritten(output_, *this);
}

BoundScene::~BoundScene() {
  if (grows_) warnAboutUnwritten(output_, *this);
}

void BoundScene::addIndirectLight() {
  if (std::any_of(lights.begin(), lights.end(),
                  [](const auto& l) { return l && l->can(TM_LIGHT_INDIRECT) && !l->filters; }))
    return;
  lights.push_back(binder_->addedIndirectLight(static_cast<int>(lights.size())));
  if (lights.back()) added = lights.back()->index;
}

void BoundScene::listLights() {
  for (const auto& light : lights) {
    if (!light) continue;
    known.add(light->index);
    if (light->can(TM_LIGHT_INDIRECT)) indirect.add(light->index);
    if (light->maxVariation != 0) interpolated.add(light->index);
  }
}

std::shared_ptr<const LightChoice> BoundScene::choiceAmong(LightList on,
                                                           std::shared_ptr<const LightChoice> longest) const {
  if (added) on.switchOn(*added);
  return std::make_shared<LightChoice>(std::move(on), std::move(longest));
}

// The objects of many lamps have lists of lights each of which is a beginning of the next. Lists that procedurals bring
// later share no sets, because their order depends on threads.
void BoundScene::shareChoices() {
  for (const ShadeGroup& group : scene.groups) choices_.try_emplace(group.attributes->lights.among(known));
  auto longest = choices_.rend();
  for (auto it = choices_.rbegin(); it != choices_.rend(); ++it) {
    // If many lamps of a tree were off, the others would get noisier.
    const bool shares =
        longest != choices_.rend() && it->first.begins(longest->first) && 2 * it->first.size() >= longest->first.size();
    it->second = choiceAmong(it->first, shares ? longest->second : nullptr);
    if (!shares) longest = it;
  }
}

void BoundScene::takeFoundPortals() {
  for (const auto& light : lights)
    if (light && light->takesFoundPortals()) light->sky->setPortals(foundPortals(scene));
}

void BoundScene::bindNewGroups() {
  for (size_t k = groups.size(); k < scene.groups.size(); ++k) {
    const Attributes& a = *scene.groups[k].attributes;
    binder_->expect(a.surface.get(), TM_SURFACE);
    binder_->expect(a.displacement.get(), TM_DISPLACEMENT);
    if (a.volume) hasVolumes = true;
    for (const auto& air : {a.atmosphere, a.interior, a.exterior}) binder_->expect(air.get(), TM_VOLUME);
  }
  binder_->prepare();
  while (groups.size() < scene.groups.size()) groups.push_back(bound(scene.groups[groups.size()]));
}

BoundGroup BoundScene::bound(const ShadeGroup& group) {
  BoundGroup g;
  g.group = &group;
  const Attributes& a = *group.attributes;
  const SourceLoc& where = group.where;
  g.object = objectName(group);
  g.surface = binder_->surface(a.surface, where, g.object);
  g.indirectSurface = binder_->indirectSurface(a, where, g.object);
  g.displacement = binder_->optional(a.displacement, g.object, TM_DISPLACEMENT);
  g.atmosphere = binder_->optional(a.atmosphere, g.object, TM_VOLUME);
  g.interior = binder_->optional(a.interior, g.object, TM_VOLUME);
  g.exterior = binder_->optional(a.exterior, g.object, TM_VOLUME);
  for (const BoundShaderPtr& shader :
       {g.surface, g.indirectSurface, g.displacement, g.atmosphere, g.interior, g.exterior})
    if (shader && !g.overrides.contains(shader.get()))
      if (std::vector<Override> found = overridesOf(*shader, group.primvars, log); !found.empty())
        g.overrides[shader.get()] = std::move(found);
  findPrimvars(g);
  LightList on = a.lights.among(known);
  std::shared_ptr<const LightChoice>& choice = choices_[on];
  if (!choice) choice = choiceAmong(std::move(on), nullptr);
  g.choice = choice;
  if (const LightList asked = g.lights().among(indirect); a.indirect.receive && !asked.empty()) {
    g.indirect = light(*asked.begin()).query;
    if (a.irradianceMaxError) g.indirect->maxError = *a.irradianceMaxError;
  }
  g.variables = bindVariables(output_, g);
  tellAir(g);
  return g;
}

}  // namespace tomales

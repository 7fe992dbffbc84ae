#include "gi/photons/surfaces.h"

#include "gi/photons/emissive_photons.h"

namespace tomales {
namespace {

vec3 shareOf(const vec3& given, const vec3& otherwise) {
  return isFinite(given) ? glm::clamp(given, 0.0f, 1.0f) : otherwise;
}

}  // namespace

PhotonSurfaces::PhotonSurfaces(const RayScene& rays, const ShadingSystem& shading, uint32_t seed, Log& log)
    : rays_(rays), shading_(shading), seed_(seed) {
  const Scene& scene = rays.scene();
  for (const ShadeGroup& g : scene.groups) {
    const std::string& name = g.attributes->photon.shadingModel;
    const std::optional<PhotonModel> model = photonModel(name);
    if (!model)
      log.report(Severity::Warning, "photons-model", scene.where,
                 "photon shadingmodel \"" + name + "\" is not known; matte is used");
    models_.push_back(model.value_or(PhotonModel::Matte));
  }
  for (size_t g = 0; g < models_.size(); ++g) even_.push_back(evenAnswer(static_cast<int>(g)));
}

std::optional<PhotonSurfaces::Answer> PhotonSurfaces::evenAnswer(int group) const {
  if (!isDiffuse(group)) return Answer{};
  if (!shading_.group(group).reflectsEvenly()) return std::nullopt;
  const int object = rays_.scene().groups[static_cast<size_t>(group)].exampleObject;
  if (object < 0) return std::nullopt;  // no ray meets the group: its objects were dropped
  const vec3 normal(0, 0, -1);
  Hit hit = hitOn(object, 0, vec2(0.5f), vec3(0), normal, normal);
  hit.t = 1;
  return ask({{vec3(0), vec3(0, 0, 1)}}, {hit}, {{}}).front();
}

/// The reflected share is the radiance at E/pi = 1, less what is emitted.
std::vector<PhotonSurfaces::Answer> PhotonSurfaces::ask(const std::vector<Ray>& rays, const std::vector<Hit>& hits,
                                                        const std::vector<SampleName>& names) const {
  ShadeContext context{
      .kind = RayKind::Diffuse, .diffuseDepth = 1, .seed = seed_, .lightSamples = 1, .indirect = false};
  context.illumination = Illumination::Unit;
  HitQuestion question;
  question.mode = HitMode::Shader;
  HitAnswers lit;
  rays_.shadeHits(rays, hits, names, shading_, context, question, lit);
  const auto emits = [&](const Hit& h) {
    return shading_.group(rays_.scene().objects[static_cast<size_t>(h.object)].group).emits();
  };
  if (std::any_of(hits.begin(), hits.end(), emits)) {
    const std::vector<vec3> dark = emittedRadiance(rays_, shading_, rays, hits, names, seed_);
    for (size_t i = 0; i < dark.size(); ++i) lit.color[i] -= dark[i];
  }
  std::vector<Answer> out(hits.size());
  for (size_t i = 0; i < out.size(); ++i) out[i] = {shareOf(lit.color[i], vec3(0)), shareOf(lit.opacity[i], vec3(1))};
  return out;
}

}  // namespace tomales

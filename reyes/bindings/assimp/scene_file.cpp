#include "reyes/bindings/assimp/scene_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "reyes/base/text.h"
#include "reyes/bindings/assimp/camera.h"
#include "reyes/bindings/assimp/lights.h"
#include "reyes/bindings/assimp/look.h"
#include "reyes/bindings/assimp/mesh.h"
#include "reyes/bindings/assimp/parts.h"
#include "reyes/bindings/assimp/ply_colors.h"

namespace tomales::model {
namespace {

/// Meshes of more numbers are binary archives beside the RIB.
constexpr size_t kMostInline = 2000;

bool isGltf(const std::string& ending) { return ending == ".gltf" || ending == ".glb" || ending == ".vrm"; }

/// Formats for 3D printers have z up; other formats that state their axis are turned by Assimp.
mat4 worldFromModel(const Settings& settings) {
  const std::string ending = endingOf(settings.model);
  const bool zUp = settings.up == "z" || (settings.up.empty() && (ending == ".stl" || ending == ".3mf"));
  return zUp ? mat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}) : mat4(1.0f);
}

class SceneWriter {
 public:
  SceneWriter(const aiScene& scene, const Settings& settings, const MtlMaterials& materials, Log& log)
      : scene_(scene),
        settings_(settings),
        materials_(materials),
        log_(log),
        where_{std::make_shared<const std::string>(settings.model), 0},
        nodes_(nodesOf(scene, worldFromModel(settings))),
        uses_(scene.mNumMeshes, 0),
        parts_(settings) {
    addLooks();
    for (const Instance& i : nodes_.instances) ++uses_[i.mesh];
  }

  void write() {
    tellOfWhatIsLeftOut();
    for (unsigned mesh = 0; mesh < scene_.mNumMeshes; ++mesh)
      if (uses_[mesh] > 0) addMesh(mesh);
    if (world_.empty())
      return log_.report(Severity::Error, "import-empty", where_, "has no geometry that could be drawn");
    writeRib();
  }

 private:
  void note(Severity severity, const char* code, const std::string& message) {
    log_.report(severity, code, where_, message);
  }

  void addLooks() {
    Textures textures(scene_, settings_, parts_, log_);
    for (unsigned k = 0; k < scene_.mNumMaterials; ++k) {
      looks_.push_back(lookOf(*scene_.mMaterials[k], textures, sourceOf(*scene_.mMaterials[k])));
      if (const Look& look = looks_.back(); !look.leftOut.empty())
        note(Severity::Warning, "import-material",
             fmt::format("material \"{}\" has properties that disney lacks: {}", look.name, look.leftOut));
      if (looks_.back().opacity == 0)
        note(Severity::Note, "import-invisible",
             fmt::format("material \"{}\" has the opacity 0: nothing that has it is visible", looks_.back().name));
    }
  }
  /// In .fbx and .dae a picture replaces a colour. Assimp makes up colours for .off, and for .obj that give none.
  LookSource sourceOf(const aiMaterial& material) const {
    const std::string ending = endingOf(settings_.model);
    LookSource out{ending == ".fbx" || ending == ".dae", ending != ".obj" && ending != ".off", {}};
    aiString name;
    material.Get(AI_MATKEY_NAME, name);
    if (const auto mtl = materials_.find(of(name)); mtl != materials_.end()) {
      out.isColorGiven = mtl->second.hasColor;
      out.placed = mtl->second.placed;
    }
    return out;
  }

  void tellOfWhatIsLeftOut() {
    if (scene_.mNumAnimations > 0)
      note(Severity::Note, "import-animation",
           fmt::format("{} animations are left out: the model is taken at rest", scene_.mNumAnimations));
    const auto count = [&](auto aiMesh::*number) {
      return std::count_if(scene_.mMeshes, scene_.mMeshes + scene_.mNumMeshes,
                           [&](const aiMesh* mesh) { return mesh->*number > 0; });
    };
    if (const auto skinned = count(&aiMesh::mNumBones); skinned > 0)
      note(Severity::Note, "import-skin",
           fmt::format("the bones of {} meshes are left out: they are taken as they were bound to them", skinned));
    if (const auto morphed = count(&aiMesh::mNumAnimMeshes); morphed > 0)
      note(Severity::Note, "import-morph",
           fmt::format("the other shapes of {} meshes are left out: each is taken in its first shape", morphed));
    if (nodes_.unusable > 0)
      note(Severity::Warning, "import-transformation",
           fmt::format("{} objects are left out, as their transformations flatten them or are no finite numbers",
                       nodes_.unusable));
  }

  /// Adds the requests that draw the mesh, or that name an archive or object with it.
  void addMesh(unsigned index) {
    const aiMesh& mesh = *scene_.mMeshes[index];
    const std::string ending = endingOf(settings_.model);
    const GeometrySettings how{settings_.subdivide, settings_.smooth_degrees, ending != ".stl",
                               ending == ".ply" ? colorsOfFaces(settings_.model) : std::vector<vec3>()};
    Geometry geometry = geometryOf(mesh, looks_[mesh.mMaterialIndex], how);
    if (geometry.unusableFaces > 0)
      note(Severity::Warning, "import-coordinates",
           fmt::format("mesh \"{}\": {} faces are left out, as their coordinates are no finite numbers", of(mesh.mName),
                       geometry.unusableFaces));
    if (geometry.requests.empty())
      return note(Severity::Warning, "import-empty", fmt::format("mesh \"{}\" has nothing to draw", of(mesh.mName)));
    if (geometry.values > kMostInline)
      geometry.requests = {call("ReadArchive", parts_.addArchive(of(mesh.mName), geometry.requests))};
    if (uses_[index] > 1) {
      const std::string handle = fmt::format("{} {}", index + 1, of(mesh.mName));
      objects_.push_back(call("ObjectBegin", handle));
      objects_.insert(objects_.end(), geometry.requests.begin(), geometry.requests.end());
      objects_.push_back(call("ObjectEnd"));
      geometry.requests = {call("ObjectInstance", handle)};
    }
    drawn_.emplace(index, std::move(geometry.requests));
    const Bound3 bound = boundOf(mesh);
    for (const Instance& i : nodes_.instances)
      if (i.mesh == index) world_.extend(transformBound(i.worldFromMesh, bound));
  }

  Camera camera() {
    for (unsigned k = 0; k < scene_.mNumCameras; ++k) {
      const aiCamera& c = *scene_.mCameras[k];
      const auto node = nodes_.worldFromNode.find(of(c.mName));
      if (!settings_.camera.empty() && settings_.camera != of(c.mName)) continue;
      const Camera out = cameraOf(isGltf(endingOf(settings_.model)) ? gltfCamera(c) : c,
                                  node == nodes_.worldFromNode.end() ? mat4(1.0f) : node->second);
      if (!out.isAngleKnown)
        note(Severity::Warning, "import-camera",
             fmt::format("camera \"{}\": Assimp does not tell its angle; {} degrees are taken", of(c.mName),
                         out.fov_degrees));
      if (transformBound(glm::inverse(out.worldFromCamera), world_).hi.z > 0) return out;
      note(Severity::Warning, "import-camera",
           fmt::format("camera \"{}\" looks away from all that there is; one that frames the model is added",
                       of(c.mName)));
      return cameraAround(world_);
    }
    if (!settings_.camera.empty()) {
      std::string names;
      for (unsigned k = 0; k < scene_.mNumCameras; ++k) names += fmt::format(" \"{}\"", of(scene_.mCameras[k]->mName));
      note(Severity::Missing, "import-camera",
           fmt::format("there is no camera \"{}\" (it has:{}); one that frames the model is added", settings_.camera,
                       names.empty() ? " none" : names));
    }
    return cameraAround(world_);
  }

  Requests lights(const Camera& camera) {
    const Lights lights = lightsOf(scene_, nodes_, {world_, settings_.lightScale, isGltf(endingOf(settings_.model))});
    if (lights.unknown > 0)
      note(Severity::Warning, "import-light",
           fmt::format("{} lights are taken as small areas: Assimp does not tell their kind and size", lights.unknown));
    if (lights.requests.empty()) return studioLights(camera.worldFromCamera);
    if (settings_.lightScale == 0 && lights.scale != 1)
      note(Severity::Note, "import-light-scale",
           fmt::format("its lights are multiplied by {:.3g}, as the picture would be too dark or too bright: "
                       "--light-scale 1 leaves them as they are",
                       lights.scale));
    return lights.requests;
  }

  void writeRib() {
    std::string rib;
    auto out = makeRibWriter({false, false, [&](std::string_view more) { rib += more; }});
    const Camera view = camera();
    const std::string picture = std::filesystem::path(settings_.scene).stem().string() + ".png";
    out->request(callWith({param("transfer", std::string("sRGB"))}, "Display", picture, "png", "rgb"));
    out->request(call("PixelSamples", 4.0f, 4.0f));
    model::write(requestsOf(view), *out);
    out->request(call("WorldBegin"));
    model::write(lights(view), *out);
    for (size_t k = 0; k < looks_.size(); ++k) {
      out->request(call("ArchiveBegin", materialName(k)));
      model::write(requestsOf(looks_[k]), *out);
      out->request(call("ArchiveEnd"));
    }
    model::write(objects_, *out);
    for (const Instance& i : nodes_.instances)
      if (const auto drawn = drawn_.find(i.mesh); drawn != drawn_.end()) writeInstance(i, drawn->second, *out);
    out->request(call("WorldEnd"));
    out.reset();  // which writes the rest
    writePart(settings_.scene, rib);
  }

  std::string materialName(size_t k) const { return fmt::format("material {} {}", k + 1, looks_[k].name); }

  void writeInstance(const Instance& i, const Requests& drawn, RiSink& out) const {
    out.request(call("AttributeBegin"));
    out.request(callWith({param("name", i.name)}, "Attribute", "identifier"));
    out.request(call("ConcatTransform", i.worldFromMesh));
    out.request(call("ReadArchive", materialName(scene_.mMeshes[i.mesh]->mMaterialIndex)));
    model::write(drawn, out);
    out.request(call("AttributeEnd"));
  }

  const aiScene& scene_;
  const Settings& settings_;
  const MtlMaterials& materials_;
  Log& log_;
  const SourceLoc where_;
  const Nodes nodes_;
  std::vector<int> uses_;  // Number of uses of each mesh.
  std::vector<Look> looks_;
  Parts parts_;
  Requests objects_;
  std::map<unsigned, Requests> drawn_;  // Indexed by mesh.
  Bound3 world_;
};

}  // namespace

void writeScene(const aiScene& scene, const Settings& settings, const MtlMaterials& materials, Log& log) {
  SceneWriter(scene, settings, materials, log).write();
}

}  // namespace tomales::model

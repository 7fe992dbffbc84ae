// The parts of a shot that a page may change: the shaders of lights, objects, the air and the picture, with their
// parameters; the colours of objects, and the lights that shine on them; and the exposure. Threads: any, after
// construction.
#pragma once
#include <map>
#include <mutex>
#include <set>

#include "reyes/scene.h"
#include "reyes/shader_registry.h"

namespace tomales {

/// Numbers, or texts.
struct ParamValue {
  std::vector<float> numbers{};
  std::vector<std::string> texts{};
  bool operator==(const ParamValue&) const = default;
};

/// A parameter that the page may change. Arrays keep their length.
struct EditableParam {
  std::string name, type;  ///< The type as RIB declares it: "float", "color", "string[2]", ...
  std::string doc;
  TmRole role;
  ParamValue value;  ///< Value in the scene as it was hidden, or the default of a shader that the scene does not use.
};

struct EditableShader {
  std::string owner;   ///< The light's handle, the objects' name, or kImager; empty where a shader is only offered.
  std::string shader;  ///< Empty if it has none.
  mat4 worldFromShader{1.0f};  ///< Parameters that are points are in this shader space, taken when the shutter opens.
  std::vector<EditableParam> params{};
  /// The parameter that names the light's group, as RIB writes it. Another shader in the light's place gets it too,
  /// since each group is a layer.
  std::string group{};

  const EditableParam* param(const std::string& name) const;
};

struct EditableObject {
  std::string name;
  vec3 color;
  std::set<std::string> lights;  ///< Handles of those that shine on it.
};

/// The kinds of shaders that may be changed.
enum ShaderSlot : size_t { kLights, kSurfaces, kAtmospheres, kImagers, kShaderSlots };
struct ShaderSlotInfo {
  const char* key;      ///< Name in JSON.
  const char* request;  ///< Name of the request in RIB.
  TmKind kind;
  const char* owner;  ///< Word for its owner in messages.
};
inline constexpr ShaderSlotInfo kSlots[kShaderSlots] = {{"lights", "LightSource", TM_LIGHT, "light"},
                                                        {"surfaces", "Surface", TM_SURFACE, "object"},
                                                        {"atmospheres", "Atmosphere", TM_VOLUME, "object"},
                                                        {"imagers", "Imager", TM_IMAGER, "picture"}};
constexpr const char* kImager = "imager";  ///< The owner of the imager shader.
constexpr const char* kNoShader = "null";  ///< As the name of an atmosphere's shader, it removes the atmosphere.

class Editable {
 public:
  /// `shaders` must outlive it. Plugins of the trusted folders alone are offered.
  Editable(const Scene& scene, ShaderRegistry& shaders, const PluginTrust& trust);

  const std::vector<EditableShader>& of(ShaderSlot slot) const { return shaders_[slot]; }
  const std::vector<EditableObject>& objects() const { return objects_; }
  const std::array<float, 2>& exposure() const { return exposure_; }  ///< Gain and gamma.
  /// Returns null if nothing of that name can be changed.
  const EditableShader* find(ShaderSlot slot, const std::string& owner) const;
  const EditableObject* object(const std::string& name) const;

  /// Returns the names of shaders that may take the place of others: built-in ones, and those of the files that the
  /// scene's shaders are looked for in.
  std::vector<std::string> offered(ShaderSlot slot) const;
  /// Returns a shader of one of these names; null if it is none of this kind. It stays as long as this object.
  const EditableShader* describe(ShaderSlot slot, const std::string& name) const;

 private:
  EditableShader describe(const std::string& owner, const ShaderCall& call, TmKind kind) const;

  ShaderRegistry& registry_;
  std::string searchPath_, pluginFolders_;
  std::string beside_;  ///< The folder of the scene.
  float shutterOpen_;
  std::array<std::vector<EditableShader>, kShaderSlots> shaders_;
  std::vector<EditableObject> objects_;
  std::array<float, 2> exposure_{1, 1};
  mutable std::mutex mutex_;  ///< Guards what follows.
  mutable std::array<std::map<std::string, EditableShader>, kShaderSlots> offered_;
};

}  // namespace tomales

// What a page has changed of a shot: numbers and colours of lights and surfaces, and the exposure. It is checked
// against the shaders before anything is made of it, and becomes an edit file of `tomales shade --edit`. Threads: plain
// values.
#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "reyes/scene.h"
#include "reyes/shader_registry.h"

namespace tomales {

using Json = nlohmann::ordered_json;

/// A request that is refused. Its text is for the page's user.
struct BadRequest : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A parameter that the page may change: it is made of floats, and no array.
struct EditableParam {
  std::string name, type;  ///< As RIB declares it: "float", "color", ...
  std::string doc;
  TmRole role;
  std::vector<float> value;  ///< In the scene as it was hidden.
};

struct EditableShader {
  std::string owner;  ///< The light's handle, or the objects' name.
  std::string shader;
  mat4 worldFromShader{1.0f};  ///< Points among the parameters are given in its space, here when the shutter opens.
  std::vector<EditableParam> params;
};

/// All that a page may change.
struct Editable {
  std::vector<EditableShader> lights, surfaces;
  std::array<float, 2> exposure{1, 1};  ///< Gain and gamma.
};

Editable editableOf(const Scene& scene, ShaderRegistry& shaders);

/// Values by owner and parameter.
using ShaderEdits = std::map<std::string, std::map<std::string, std::vector<float>>>;

struct EditState {
  ShaderEdits lights, surfaces;
  std::optional<std::array<float, 2>> exposure;
  bool operator==(const EditState&) const = default;
};

/// Throws BadRequest if it names what is not editable, or if a value does not fit.
EditState stateOf(const Json& json, const Editable& editable);
Json jsonOf(const EditState& state);
/// The edit file of a state: the same text for the same state.
std::string ribOf(const EditState& state, const Editable& editable);
/// The state of an edit file. Throws BadRequest if it changes more than a page can.
EditState stateOfRib(const std::string& file, const Editable& editable, Log& log);

}  // namespace tomales

// The changes that a page has made to a shot. They are first checked against what may be changed, and then become an
// edit file of `tomales shade --edit`. Threads: plain values.
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "reyes/app/relight/editable.h"

namespace tomales {

using Json = nlohmann::ordered_json;

/// A request that is refused. Its text is for the page's user.
struct BadRequest : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A request of a page that watches while another one edits.
struct Watches : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ShaderEdit {
  std::string shader{};  ///< Name of the shader that replaces the scene's; empty if that stays.
  std::map<std::string, ParamValue> params{};
  bool operator==(const ShaderEdit&) const = default;
};
struct ObjectEdit {
  std::optional<std::array<float, 3>> color{};
  std::map<std::string, bool> lights{};  ///< Indexed by handle: true if the light shines on the object.
  bool operator==(const ObjectEdit&) const = default;
};

struct EditState {
  std::array<std::map<std::string, ShaderEdit>, kShaderSlots> shaders{};  ///< Indexed by owner.
  std::map<std::string, ObjectEdit> objects{};
  std::optional<std::array<float, 2>> exposure{};
  bool operator==(const EditState&) const = default;

  const ShaderEdit* edit(ShaderSlot slot, const std::string& owner) const;
};

/// Returns the shader of an owner under an edit, with the values that it has without the edit's parameters.
const EditableShader& shaderUnder(const EditState& state, ShaderSlot slot, const std::string& owner,
                                  const Editable& editable);

/// Throws BadRequest if it names something that cannot be changed, or if a value does not fit.
EditState stateOf(const Json& json, const Editable& editable);
Json jsonOf(const EditState& state);
Json jsonOf(const ParamValue& value);
/// Returns the edit file of a state: the same text for the same state.
std::string ribOf(const EditState& state, const Editable& editable);
/// Returns the state of edit files, of which the later ones change the earlier. Throws BadRequest if they change more
/// than a page can.
EditState stateOfRib(const std::vector<std::string>& files, const Editable& editable);

}  // namespace tomales

#include "reyes/rib/variables.h"

#include <fmt/format.h>

namespace tomales::rib {
namespace {

using Found = std::optional<std::string>;

Found text(const std::map<std::string, Param>& all, const std::string& key) {
  const auto it = all.find(key);
  if (it == all.end()) return std::nullopt;
  const Param& p = it->second;
  return p.type == ValueType::String ? (p.strings.empty() ? "" : p.strings[0]) : fmt::format("{}", p.number(0));
}

Found option(const Options& o, const std::string& key) {
  if (key == "Frame") return fmt::format("{}", o.frame);
  return text(o.user, key);
}

// Returns the attributes with a place of their own that scenes ask about.
Found attribute(const Attributes& a, const std::string& key) {
  const auto flag = [](bool b) { return b ? "1" : "0"; };
  if (key == "identifier:name") return a.name;
  if (key == "visibility:camera") return flag(a.visibility.camera);
  if (key == "visibility:diffuse") return flag(a.visibility.diffuse);
  if (key == "visibility:specular") return flag(a.visibility.specular);
  if (key == "visibility:transmission") return flag(a.visibility.transmission);
  if (key == "visibility:photon") return flag(a.visibility.photon);
  if (key == "displacementbound:sphere") return fmt::format("{}", a.displacementBound);
  if (key == "Matte") return flag(a.matte);
  if (key == "Sides") return fmt::format("{}", a.sides);
  if (key == "ShadingRate") return fmt::format("{}", a.shadingRate);
  return text(a.user, key);
}

}  // namespace

Found findVariable(const Options& options, const Attributes& attributes, const std::string& name) {
  constexpr std::string_view kOption = "Option:", kAttribute = "Attribute:";
  if (name.starts_with(kOption)) return option(options, name.substr(kOption.size()));
  if (name.starts_with(kAttribute)) return attribute(attributes, name.substr(kAttribute.size()));
  if (auto v = text(attributes.user, "user:" + name)) return v;
  if (auto v = text(options.user, "user:" + name)) return v;
  if (auto v = attribute(attributes, name)) return v;
  return option(options, name);
}

}  // namespace tomales::rib

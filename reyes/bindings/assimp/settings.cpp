#include "reyes/bindings/assimp/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace tomales::model {
namespace {

std::string textOf(const std::string& value) { return value; }
std::string textOf(float value) { return fmt::format("{}", value); }
std::string textOf(bool value) { return value ? "1" : ""; }

void read(const std::string& text, std::string& value) { value = text; }
void read(const std::string& text, float& value) { value = std::strtof(text.c_str(), nullptr); }
void read(const std::string& text, bool& value) { value = !text.empty(); }

template <class Of, class Visit>
void visitFields(Of& settings, const Visit& visit) {
  visit("model", settings.model), visit("scene", settings.scene), visit("parts", settings.parts);
  visit("partsByName", settings.partsByName), visit("subdivide", settings.subdivide);
  visit("smooth", settings.smooth_degrees), visit("up", settings.up), visit("lightScale", settings.lightScale);
  visit("camera", settings.camera);
}

}  // namespace

std::vector<std::string> argumentsOf(const Settings& settings) {
  std::vector<std::string> out;
  visitFields(settings, [&](const char* name, const auto& value) { out.push_back(name + ("=" + textOf(value))); });
  return out;
}

int mostSeconds(const Settings& settings) {
  constexpr int kLeast = 120, kMost = 3600;  // a small .gltf may name large files
  constexpr uintmax_t kBytesOfSecond = 1'000'000;
  std::error_code unknown;
  const uintmax_t bytes = std::filesystem::file_size(settings.model, unknown);
  return unknown ? kLeast : kLeast + static_cast<int>(std::min<uintmax_t>(bytes / kBytesOfSecond, kMost));
}

Settings settingsOf(const std::vector<std::string>& arguments) {
  Settings out;
  for (const std::string& argument : arguments) {
    const size_t equals = std::min(argument.find('='), argument.size());
    visitFields(out, [&](const char* name, auto& value) {
      if (argument.compare(0, equals, name) == 0 && equals < argument.size()) read(argument.substr(equals + 1), value);
    });
  }
  return out;
}

}  // namespace tomales::model

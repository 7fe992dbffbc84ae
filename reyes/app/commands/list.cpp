#include "reyes/app/commands/list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "reyes/app/commands/shader_info.h"
#include "reyes/app/exit_code.h"
#include "reyes/image.h"
#include "reyes/image_files.h"

namespace tomales {
namespace {

/// Lists built-in shaders by name, those of one kind or all.
Json shaders(std::optional<TmKind> kind) {
  Log log;
  ShaderRegistry registry(log);
  registry.addLibrary(tomales_builtin_shaders(), "built-in");
  Json out = Json::array();
  for (const TmShader* s : registry.all())
    if (!kind || s->kind == *kind) out.push_back(shaderInfo(*s));
  return out;
}

Json filters() {
  Json out = Json::array();
  for (const std::string& name : PixelFilter::names()) {
    const PixelFilter filter(name, 2, 2);
    out.push_back({{"name", name}, {"doc", filter.hasNegativeLobes() ? "sharpens: it has negative lobes" : ""}});
  }
  return out;
}

Json displays() {
  Json out = Json::array();
  for (const DisplayFormat& f : displayFormats())
    out.push_back({{"name", f.type},
                   {"doc", f.title},
                   {"other_types", f.otherTypes},
                   {"extensions", f.extensions},
                   {"compressions", f.compressions},
                   {"own_parameters", f.parameters}});
  return out;
}

struct Listed {
  const char* name;
  Json (*list)();
};
const Listed kListed[] = {{"shaders", [] { return shaders(std::nullopt); }},
                          {"surfaces", [] { return shaders(TM_SURFACE); }},
                          {"displacements", [] { return shaders(TM_DISPLACEMENT); }},
                          {"lights", [] { return shaders(TM_LIGHT); }},
                          {"volumes", [] { return shaders(TM_VOLUME); }},
                          {"imagers", [] { return shaders(TM_IMAGER); }},
                          {"displays", displays},
                          {"filters", filters}};

/// Prints a line for each thing, and one for each of its parameters.
void printText(const Json& listed) {
  for (const Json& one : listed) {
    const std::string kind = one.contains("kind") ? one.at("kind").get<std::string>() + " " : "";
    const auto doc = one.at("doc").get<std::string>();
    std::puts(fmt::format("{}{}{}{}", kind, one.at("name").get<std::string>(), doc.empty() ? "" : ": ", doc).c_str());
    for (const auto& [key, value] : one.items())
      if (isScalarList(value) && !value.empty() && key != "parameters")
        std::puts(fmt::format("    {}: {}", key, lineOf(value)).c_str());
    for (const Json& p : one.value("parameters", Json::array())) {
      const Json fallback = p.value("default", Json());
      const bool single = fallback.is_array() && fallback.size() == 1;
      const std::string value = fallback.is_null() ? "" : "= " + lineOf(single ? fallback[0] : fallback);
      std::puts(fmt::format("    {:7} {:18} {:14} {}", p.at("type").get<std::string>(), p.at("name").get<std::string>(),
                            value, p.at("doc").get<std::string>())
                    .c_str());
    }
  }
}

}  // namespace

std::vector<std::string> listedKinds() {
  std::vector<std::string> out;
  for (const Listed& l : kListed) out.push_back(l.name);
  return out;
}

int listCommand(const std::string& kind, bool json) {
  const auto* listed =
      std::find_if(std::begin(kListed), std::end(kListed), [&](const Listed& l) { return l.name == kind; });
  const Json out = listed->list();
  if (json)
    std::puts(out.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  else
    printText(out);
  return kDone;
}

}  // namespace tomales

// Sources of DisplayChannels of the RIS era, which are names after a type, and light path expressions.
#include <unordered_map>

#include "reyes/rib/ris.h"

namespace tomales::rib {
namespace {

// Returns the standard outputs that correspond to some of RenderMan's own presets. The part of a preset before its last
// semicolon says how to sample, not what.
std::string_view outputOfPaths(std::string_view expression) {
  static const std::unordered_map<std::string_view, std::string_view> table = {
      {"C<RD>[<L.>O]", "diffuse"},  {"C<RD>[DS]+[<L.>O]", "indirectdiffuse"},
      {"C<RS>[<L.>O]", "specular"}, {"C<RS>[DS]+[<L.>O]", "reflection"},
      {"C(U2L)|O", "albedo"},       {"C<.S'passthru'>*((U2L)|O)", "albedo"},
      {"C[DS]*[<L.>O]", "Ci"},      {"C.*[<L.>O]", "Ci"}};
  if (const size_t flags = expression.rfind(';'); flags != expression.npos) expression.remove_prefix(flags + 1);
  const auto it = table.find(expression);
  return it == table.end() ? std::string_view() : it->second;
}

}  // namespace

std::string risSource(const std::string& source) {
  std::string_view rest = source;
  if (const size_t space = rest.find_first_of(" \t"); space != rest.npos && rest.find(':') > space)
    rest.remove_prefix(rest.find_first_not_of(" \t", space));
  if (rest == "Nn") return "normal";
  if (rest == "zfiltered") return "z";
  if (!rest.starts_with("lpe:")) return std::string(rest);
  const std::string_view known = outputOfPaths(rest.substr(4));
  return std::string(known.empty() ? rest : known);
}

}  // namespace tomales::rib

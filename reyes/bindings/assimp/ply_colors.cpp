#include "reyes/bindings/assimp/ply_colors.h"

#include <algorithm>

#include "reyes/base/ply_reader.h"

namespace tomales::model {
namespace {

/// Returns the channel of a face's property; -1 if it is no colour.
int channelOf(const PlyProperty& p) {
  static constexpr const char* kChannels[] = {"red", "green", "blue"};
  const auto* found = std::find(std::begin(kChannels), std::end(kChannels), p.name);
  return found == std::end(kChannels) || p.length ? -1 : static_cast<int>(found - std::begin(kChannels));
}

bool hasColors(const PlyElement& face) {
  return std::ranges::any_of(face.properties, [](const PlyProperty& p) { return channelOf(p) == 0; });
}

vec3 colorOfFace(PlyReader& file, const PlyElement& face) {
  vec3 out(0.0f);
  for (const PlyProperty& p : face.properties) {
    const double count = p.length ? file.number(*p.length) : 1;
    for (double k = 0; k < count; ++k) {
      const double share = file.number(p.type) / p.type.whole;
      // What is no number counts as 0.
      if (const int channel = channelOf(p); channel >= 0 && share > 0)
        out[channel] = static_cast<float>(std::min(share, 1.0));
    }
  }
  return out;
}

}  // namespace

std::vector<vec3> colorsOfFaces(const std::string& path) {
  try {
    PlyReader file(path);
    const auto face = std::ranges::find(file.elements(), "face", &PlyElement::name);
    if (face == file.elements().end() || !hasColors(*face)) return {};
    for (auto before = file.elements().begin(); before != face; ++before) file.skip(*before);
    std::vector<vec3> colors;
    for (uint64_t i = 0; i < face->count; ++i) colors.push_back(colorOfFace(file, *face));
    return colors;
  } catch (const FileError&) {
    return {};  // Assimp tells of files that are damaged.
  }
}

}  // namespace tomales::model

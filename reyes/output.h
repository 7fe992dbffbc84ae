// Noun: what the Displays of a frame ask for, worked out of Options. Shading stores the variables, filtering makes the
// channels, each Display writes some floats of them.
//
//   FrameOutput 1--* Variable   floats that shading keeps for every visible point
//               1--* Channel    floats of a pixel; 0, 1, 2 are always Ci, a and z
//               1--* Selection  one for each Display: which floats, under which names
#pragma once
#include "reyes/state.h"

namespace tomales {

/// How the samples around a pixel become its value. Filter: the weighted mean. The others look at the samples that see
/// a surface: the value of the nearest or the farthest one, the least or the greatest value, the plain mean.
enum class Reduce : uint8_t { Filter, ZMin, ZMax, Min, Max, Average };

struct Sampling {
  Reduce reduce = Reduce::Filter;
  std::string filter = "box";  ///< Of Reduce::Filter.
  float xWidth = 1, yWidth = 1;
  bool operator==(const Sampling&) const = default;
};

struct Variable {
  std::string source;  ///< Of a shader, the surface, a primitive variable, or "lightgroup:NAME".
  ValueType type = ValueType::Float;
  float fill = 0;   ///< Where nobody writes it.
  int first = 0;    ///< Of its arrays in ShadedPoints::variables.
  SourceLoc where;  ///< The request that asks for it.
};

/// Objects, Materials: Cryptomatte, six ranks of id and coverage.
enum class ChannelKind : uint8_t { Color, Alpha, Depth, Variable, Objects, Materials };
inline bool isMatte(ChannelKind kind) { return kind == ChannelKind::Objects || kind == ChannelKind::Materials; }
/// Names of Cryptomatte layers.
inline const char* matteLayer(ChannelKind kind) {
  return kind == ChannelKind::Objects ? "CryptoObject" : "CryptoMaterial";
}

struct Channel {
  std::string name;
  ChannelKind kind = ChannelKind::Variable;
  ValueType type = ValueType::Color;
  int variable = -1;        ///< In FrameOutput::variables.
  bool composited = false;  ///< Colours: what lies behind shines through. Else the nearest surface counts alone.
  Sampling sampling;
  float fill = 0;  ///< Of samples that see nothing.
  int first = 0;   ///< Its first float in a pixel of the frame's picture.
  int width() const { return isMatte(kind) ? 12 : floatsPerValue(type); }
};

/// What a Display or DisplayChannel asks to be done to values on their way to the file.
struct Encoding {
  std::optional<std::array<float, 2>> exposure;  ///< Gain, gamma; of Ci on top of the frame's Exposure.
  std::optional<Quantize> quantize;
};

/// One float of a Display.
struct SelectedFloat {
  int channel, component;
  std::string name;  ///< In the file: R G B A Z, name.R, name.X, name.
  Encoding encoding;
};

using Selection = std::vector<SelectedFloat>;

struct FrameOutput {
  std::vector<Variable> variables;
  std::vector<Channel> channels;
  std::vector<Selection> displays;  ///< As Options::displays.
  int floatsPerPoint = 0;           ///< Of all variables.
  int floatsPerPixel = 5;           ///< Of all channels.
  bool shades = true;               ///< False: depth alone is wanted, opaque surfaces need no shader.
  /// Names of the floats of the frame's picture, as they stand in a pixel.
  std::vector<std::string> names() const;
};

/// FrameOutput::shades alone.
bool shades(const Options& options);

/// Reports channels that are not declared, and parameters that are not understood, if `log` is given.
FrameOutput outputOf(const Options& options, Log* log = nullptr);

/// Does the type of a Display want depth and nothing else: "shadow", "zfile"?
bool writesShadowMap(const DisplayCall& display);
/// "deepshad", "deepexr": a list of depths in every pixel?
bool writesDeep(const DisplayCall& display);

}  // namespace tomales

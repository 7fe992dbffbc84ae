// Noun: the variables and channels that the Displays of a frame need, derived from Options. Shading stores the
// variables, filtering makes the channels, and each Display writes some floats of them.
//
//   FrameOutput 1--* Variable   floats that shading keeps for every visible point
//               1--* Channel    floats of a pixel; 0, 1, 2 are always Ci, a and z
//               1--* Selection  one for each Display: which floats, under which names
#pragma once
#include "reyes/surface_variables.h"

namespace tomales {

/// The way in which the samples around a pixel become its value. Filter takes their weighted mean. The others use only
/// samples that see a surface: they take the value of the nearest or the farthest one, the least or the greatest value,
/// or the plain mean.
enum class Reduce : uint8_t { Filter, ZMin, ZMax, Min, Max, Average };

struct Sampling {
  Reduce reduce = Reduce::Filter;
  std::string filter = "box";  ///< Used by Reduce::Filter.
  float xWidth = 1, yWidth = 1;
  bool operator==(const Sampling&) const = default;
};

struct Variable {
  /// An output variable of a shader, a standard variable, a primitive variable, or "lightgroup:NAME".
  std::string source;
  ValueType type = ValueType::Float;
  float fill = 0;   ///< Value where nothing writes it.
  int first = 0;    ///< First of its arrays in ShadedPoints::variables.
  SourceLoc where;  ///< Location of the request that asks for it.
};

/// Prefix of the variables that hold the light of a group of lights.
constexpr std::string_view kLightGroup = "lightgroup:";

inline bool isMatte(ChannelKind kind) { return kind == ChannelKind::Objects || kind == ChannelKind::Materials; }
/// Returns the name of a Cryptomatte layer.
inline const char* matteLayer(ChannelKind kind) {
  return kind == ChannelKind::Objects ? "CryptoObject" : "CryptoMaterial";
}

struct Channel {
  std::string name;
  ChannelKind kind = ChannelKind::Variable;
  ValueType type = ValueType::Color;
  int variable = -1;        ///< Index in FrameOutput::variables.
  bool composited = false;  ///< Colours: surfaces behind shine through. Otherwise only the nearest surface counts.
  Sampling sampling;
  float fill = 0;  ///< Value of samples that see nothing.
  int first = 0;   ///< Its first float in a pixel of the frame's picture.
  int width() const { return isMatte(kind) ? 12 : floatsPerValue(type); }
};

/// The encoding of values that a Display or DisplayChannel asks for.
struct Encoding {
  std::optional<std::array<float, 2>> exposure;  ///< Gain and gamma; those for Ci come on top of the frame's Exposure.
  std::optional<Quantize> quantize;
};

/// One float of a Display.
struct SelectedFloat {
  int channel, component;
  std::string name;  ///< Name in the file: R G B A Z, name.R, name.X, name.
  Encoding encoding;
};

using Selection = std::vector<SelectedFloat>;

struct FrameOutput {
  std::vector<Variable> variables;
  std::vector<Channel> channels;
  std::vector<Selection> displays;  ///< Indexed as Options::displays.
  int floatsPerPoint = 0;           ///< Floats of all variables.
  int floatsPerPixel = 5;           ///< Floats of all channels.
  bool shades = true;               ///< False if only depth is wanted, so that opaque surfaces need no shader.
  /// Returns the names of the floats of a pixel of the frame's picture, in order.
  std::vector<std::string> names() const;
};

/// Computes FrameOutput::shades alone.
bool shades(const Options& options);

/// Derives the output from the Displays. If `log` is given, it reports channels that are not declared and parameters
/// that are not understood.
FrameOutput outputOf(const Options& options, Log* log = nullptr);

/// Tells whether the Display writes a map for later frames and shows nothing, as types "shadow", "zfile" and "deepshad"
/// do.
bool writesMap(const DisplayCall& display);
/// Tells whether it writes such a map of one depth for each pixel, as types "shadow" and "zfile" do.
bool writesShadowMap(const DisplayCall& display);
/// Tells whether it writes a list of depths for every pixel, as types "deepshad" and "deepexr" do.
bool writesDeep(const DisplayCall& display);

}  // namespace tomales

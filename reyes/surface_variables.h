// Noun: the table of variables of surfaces that every picture may show by name (RISpec 3.2 table 12.1), and two for
// denoisers. It tells where each comes from, and in which kind of channel a picture stores it. Outputs of shaders and
// primitive variables are not listed here.
#pragma once
#include <string_view>

#include "reyes/points.h"
#include "reyes/state.h"

namespace tomales {

/// Objects and Materials are Cryptomatte layers: six ranks of id and coverage.
enum class ChannelKind : uint8_t { Color, Alpha, Depth, Variable, Objects, Materials };

/// The place where shading finds a variable of a point.
enum class VariableSource : uint8_t {
  Nothing,     ///< Nobody writes it, or (kinds other than Variable) the hider knows it.
  Channel,     ///< A channel of ShadePoints, of which `channel` is the first.
  Color,       ///< Cs of the shader, times its opacity.
  Opacity,     ///< Oi.
  Normal,      ///< The unit normal towards the viewer.
  Output,      ///< An output of the surface shader.
  LightGroup,  ///< The light that some of the lights bring.
  Noise,       ///< The difference from Ci when all noise is drawn again, over the root of 2; not found by shading.
};

struct SurfaceVariable {
  std::string_view name;
  ValueType type;
  ChannelKind kind = ChannelKind::Variable;
  VariableSource source = VariableSource::Nothing;
  int channel = 0;
};

inline constexpr SurfaceVariable kSurfaceVariables[] = {
    {"Ci", ValueType::Color, ChannelKind::Color},
    {"a", ValueType::Float, ChannelKind::Alpha},
    {"alpha", ValueType::Float, ChannelKind::Alpha},
    {"z", ValueType::Float, ChannelKind::Depth},
    {"cryptoobject", ValueType::Color, ChannelKind::Objects},
    {"cryptomaterial", ValueType::Color, ChannelKind::Materials},
    {"Cs", ValueType::Color, ChannelKind::Variable, VariableSource::Color},
    {"albedo", ValueType::Color, ChannelKind::Variable, VariableSource::Color},
    {"Os", ValueType::Color, ChannelKind::Variable, VariableSource::Opacity},
    {"Oi", ValueType::Color, ChannelKind::Variable, VariableSource::Opacity},
    {"standarderror", ValueType::Color, ChannelKind::Variable, VariableSource::Noise},
    {"normal", ValueType::Normal, ChannelKind::Variable, VariableSource::Normal},
    {"P", ValueType::Point, ChannelKind::Variable, VariableSource::Channel, kPx},
    {"N", ValueType::Normal, ChannelKind::Variable, VariableSource::Channel, kNx},
    {"Ng", ValueType::Normal, ChannelKind::Variable, VariableSource::Channel, kNgx},
    {"I", ValueType::Vector, ChannelKind::Variable, VariableSource::Channel, kIx},
    {"dPdu", ValueType::Vector, ChannelKind::Variable, VariableSource::Channel, kDpduX},
    {"dPdv", ValueType::Vector, ChannelKind::Variable, VariableSource::Channel, kDpdvX},
    {"u", ValueType::Float, ChannelKind::Variable, VariableSource::Channel, kU},
    {"v", ValueType::Float, ChannelKind::Variable, VariableSource::Channel, kV},
    {"s", ValueType::Float, ChannelKind::Variable, VariableSource::Channel, kS},
    {"t", ValueType::Float, ChannelKind::Variable, VariableSource::Channel, kT},
    {"du", ValueType::Float, ChannelKind::Variable, VariableSource::Channel, kDu},
    {"dv", ValueType::Float, ChannelKind::Variable, VariableSource::Channel, kDv},
};

/// Returns null if there is none.
constexpr const SurfaceVariable* surfaceVariable(std::string_view name) {
  for (const SurfaceVariable& v : kSurfaceVariables)
    if (v.name == name) return &v;
  return nullptr;
}

}  // namespace tomales

// The agreements between compiled RSL shaders and their host beyond those that every shader may declare
// (reyes/shader_api.h): no plugin needs them.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reyes/shader_api.h"

namespace tomales {

/// Added to the type of a parameter that is an array or a matrix: primitive variables of the same name and length
/// override it. TmValue::step is 1 then, and element e of component k of point i is c[k][e * components * padded + i].
/// Component k of a matrix is c[0][(e * 16 + k) * padded + i].
constexpr int32_t kArrayVaries = 0x10000;

/// The samples of a light with an extent, such as an area, that does not say how many it wants. Lights in RSL declare
/// it.
constexpr int kDefaultLightSamples = 16;

/// Added to the type of an output parameter that the shader assigns later, so that its value is only the initial one.
/// Message passing does not return that value.
constexpr int32_t kBeginsOutput = 0x20000;

/// Returns the form of a light that AreaLightSource runs: its P lies on the geometry. Returns null if the light is not
/// written in RSL, or does not read P.
const TmShader* rslAreaLight(const TmShader& light);
/// Tells whether the shader is such a form. Its Cl is not the radiance of the geometry, but the light that a lamp at
/// that point alone would bring. The light of the area is the mean of that.
bool isMean(const TmShader& light);
/// Tells whether the shader is such a form, and with these parameters may shine from both sides of its geometry: it is
/// not one whose illuminate() has a cone around N of at most a right angle. It computes the cone, which takes time.
bool shinesAllRound(const TmShader& light, const TmValue* params);

/// The value of a shader's parameter, for other shaders that ask for it.
struct RslValue {
  bool varies = false;
  /// If it varies, component k of point i is [k * padded + i]; else element by element, component by component. Empty
  /// for texts.
  std::vector<float> floats;
  std::vector<std::string> texts;
};
/// Tells whether the shader is written in RSL and computes the default of that parameter when it runs.
bool rslComputesDefault(const TmShader& shader, int32_t parameter);
/// Finds the value of such a parameter at the active points of a grid, whose `params` are those of the shader. Arrays
/// and matrices are those of the first active point.
RslValue rslValue(const TmShader& shader, int32_t parameter, const TmGrid& grid);
/// Does the same before anything is shaded. Returns nothing if the value depends on the points or on the scene.
std::optional<RslValue> rslFixedValue(const TmShader& shader, int32_t parameter, const TmValue* params);

/// The files that a shader needs when it runs, such as textures.
struct RslReads {
  /// Plugins whose functions it calls; constants and defaults of parameters, among which the names of files are.
  std::vector<std::string> names;
  bool isKnown = true;  ///< False if a name is computed, or told by the scene or another shader.
};
/// Returns none if the shader is not written in RSL.
RslReads rslReads(const TmShader& shader);

/// Returns the texts that stand in the code of a shader, such as names of pictures; none if it is not written in RSL.
std::vector<std::string> rslTexts(const TmShader& shader);

}  // namespace tomales

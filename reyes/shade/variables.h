// The variables of a surface that Displays store beside its colour and opacity: outputs of the shader, geometry, light
// groups.
#pragma once
#include "reyes/output.h"
#include "reyes/points.h"
#include "reyes/shade.h"
#include "reyes/shade/bound_shader.h"

namespace tomales {

class Batch;
struct BoundGroup;

/// The source of one of FrameOutput::variables for a group.
struct BoundVariable {
  VariableSource from = VariableSource::Nothing;
  int index = 0;             ///< The number of a channel in ShadePoints, or of an output in TmShader::params.
  bool composited = false;   ///< True for a channel that is a colour and becomes premultiplied.
  std::string lights;        ///< The name of a LightGroup; empty for light without a group.
  int first = 0, width = 1;  ///< Its place in ShadedPoints::variables.
  float fill = 0;
};

/// Finds the source of each variable. An output of the surface shader takes precedence over anything else of that name.
std::vector<BoundVariable> bindVariables(const FrameOutput& output, const BoundGroup& group);

/// Does the same for "surface:NAME" of a ray's caller: finds the outputs of the shader that runs at the hit, in the
/// order of `told`.
std::vector<BoundVariable> bindOutputs(const std::vector<RayOutput>& told, const BoundShader& shader);

/// Allocates the variables, filled with the values that they have where nothing writes them.
void allocateVariables(const std::vector<BoundVariable>& variables, int count, ShadedPoints& out);
/// Stores all other variables after the shader has run. For light groups it runs the shader again, on the same light
/// samples. A group's share is the result with its lights alone minus the result with no lights. So all groups and ""
/// add up to Ci wherever Ci is linear in light.
void storeVariables(const std::vector<BoundVariable>& variables, Batch& batch, const BoundShader& shader,
                    ShadedPoints& out, int begin);

}  // namespace tomales

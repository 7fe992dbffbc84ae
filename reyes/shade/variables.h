// What Displays ask of a surface beside its colour and opacity: outputs of the shader, geometry, light groups.
#pragma once
#include "reyes/output.h"
#include "reyes/points.h"
#include "reyes/shade.h"
#include "reyes/shade/bound_shader.h"

namespace tomales {

class Batch;
struct BoundGroup;

/// Where a group finds one of FrameOutput::variables.
struct BoundVariable {
  VariableSource from = VariableSource::Nothing;
  int index = 0;             ///< Channel: of ShadePoints. Output: of TmShader::params.
  bool composited = false;   ///< Channel: a colour, which arrives premultiplied.
  std::string lights;        ///< LightGroup: its name; empty: what no light brings.
  int first = 0, width = 1;  ///< In ShadedPoints::variables.
  float fill = 0;
};

/// An output of the surface shader goes before all else of that name.
std::vector<BoundVariable> bindVariables(const FrameOutput& output, const BoundGroup& group);

/// The same of what a ray's caller asks: outputs of the shader that runs at its hit, in this order. Of "surface:NAME"
/// alone.
std::vector<BoundVariable> bindOutputs(const std::vector<RayOutput>& told, const BoundShader& shader);

/// Makes room, filled with what stands where nobody writes.
void allocateVariables(const std::vector<BoundVariable>& variables, int count, ShadedPoints& out);
/// After it has run: everything else. Runs it again for light groups, on the same light samples: a group's share is
/// what the shader makes of its lights alone, less what it makes of none, so that all groups and "" add up to Ci
/// wherever Ci is linear in light.
void storeVariables(const std::vector<BoundVariable>& variables, Batch& batch, const BoundShader& shader,
                    ShadedPoints& out, int begin);

}  // namespace tomales
